// SPDX-License-Identifier: BSD-3-Clause
#include "fild/graph/max_clique.h"

#include "message_of.h"

#include <chrono>
#include <random>

namespace
{
using fild::largest_clique;
using fild::testing::message_of;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

using Adjacency = std::vector<std::vector<bool>>;

Adjacency without_edges(std::size_t size)
{
    return Adjacency(size, std::vector<bool>(size, false));
}

void join(Adjacency& graph, std::size_t a, std::size_t b)
{
    graph[a][b] = graph[b][a] = true;
}

Adjacency random_graph(std::size_t size, double density, std::uint64_t seed)
{
    std::mt19937_64 generator(seed);
    auto graph = without_edges(size);
    for (std::size_t a = 0; a < size; ++a)
        for (std::size_t b = 0; b < a; ++b)
            if (static_cast<double>(generator() % 1000) < 1000 * density) join(graph, a, b);
    return graph;
}

bool is_clique(const Adjacency& graph, const std::vector<std::size_t>& vertices)
{
    for (const auto a : vertices)
        for (const auto b : vertices)
            if (a != b && !graph[a][b]) return false;
    return true;
}

/** Size of the largest clique, by looking at every set of vertices. */
std::size_t brute_force(const Adjacency& graph)
{
    std::size_t best = 0;
    for (std::size_t set = 0; set < std::size_t{1} << graph.size(); ++set)
    {
        std::vector<std::size_t> vertices;
        for (std::size_t v = 0; v < graph.size(); ++v)
            if (((set >> v) & 1U) != 0) vertices.push_back(v);
        if (vertices.size() > best && is_clique(graph, vertices)) best = vertices.size();
    }
    return best;
}

TEST(LargestClique, OfNothingIsNothing)
{
    EXPECT_THAT(largest_clique({}).vertices, IsEmpty());
    EXPECT_EQ(largest_clique({}).upper_bound, 0U);
}

TEST(LargestClique, WithoutEdgesIsOneVertex)
{
    EXPECT_EQ(largest_clique(without_edges(5)).vertices.size(), 1U);
    EXPECT_THAT(largest_clique(without_edges(1)).vertices, ElementsAre(0));
}

TEST(LargestClique, FindsATriangleBesideALongPath)
{
    auto graph = without_edges(70);
    for (std::size_t i = 1; i < 60; ++i) join(graph, i - 1, i);
    join(graph, 3, 65);
    join(graph, 3, 69);
    join(graph, 65, 69);
    EXPECT_THAT(largest_clique(graph).vertices, ElementsAre(3, 65, 69));
}

TEST(LargestClique, IsAsLargeAsThatOfBruteForce)
{
    for (std::uint64_t seed = 0; seed < 40; ++seed)
        for (const double density : {0.2, 0.5, 0.8})
        {
            const auto graph = random_graph(13, density, seed);
            const auto clique = largest_clique(graph);
            EXPECT_TRUE(is_clique(graph, clique.vertices));
            EXPECT_EQ(clique.vertices.size(), brute_force(graph)) << seed << " " << density;
            EXPECT_EQ(clique.upper_bound, clique.vertices.size());
        }
}

// 500 loops: 350 that agree but for one pair in a hundred thousand, and 150 random ones.
TEST(LargestClique, OfFiveHundredLoopsIsFoundInTime)
{
    auto graph = random_graph(500, 0.05, 7);
    for (std::size_t a = 0; a < 350; ++a)
        for (std::size_t b = 0; b < a; ++b) join(graph, a, b);
    graph[10][20] = graph[20][10] = graph[30][40] = graph[40][30] = false;
    const auto start = std::chrono::steady_clock::now();
    const auto clique = largest_clique(graph);
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    EXPECT_EQ(clique.vertices.size(), 348U);
    EXPECT_EQ(clique.upper_bound, 348U);
    EXPECT_LT(elapsed.count(), 5);
}

TEST(LargestClique, GivesUpWithABoundAndTheSameAnswerEachTime)
{
    const auto graph = random_graph(200, 0.9, 3);
    const auto clique = largest_clique(graph, fild::never_cancelled, 50);
    EXPECT_TRUE(is_clique(graph, clique.vertices));
    EXPECT_GT(clique.upper_bound, clique.vertices.size());
    EXPECT_GT(clique.vertices.size(), 25U);
    EXPECT_EQ(largest_clique(graph, fild::never_cancelled, 50).vertices, clique.vertices);
}

TEST(LargestClique, RefusesWhatIsNoGraph)
{
    EXPECT_THAT(message_of<std::invalid_argument>(
                    [] {
                        largest_clique({{false}, {false}});
                    }),
                HasSubstr("not square"));
    EXPECT_THAT(message_of<std::invalid_argument>(
                    [] {
                        largest_clique({{false, true}, {false, false}});
                    }),
                HasSubstr("not symmetric"));
}

}  // namespace
