// SPDX-License-Identifier: BSD-3-Clause
#include "fild/graph/max_clique.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <stdexcept>

namespace fild
{
namespace
{
/** A set of vertices, one bit each. */
class VertexSet
{
 public:
    explicit VertexSet(std::size_t size) : words_((size + kBits - 1) / kBits) {}

    void insert(std::size_t vertex) { words_[vertex / kBits] |= bit(vertex); }
    void erase(std::size_t vertex) { words_[vertex / kBits] &= ~bit(vertex); }
    bool empty() const
    {
        return std::all_of(words_.begin(), words_.end(), [](auto word) { return word == 0; });
    }
    std::size_t size() const
    {
        std::size_t count = 0;
        for (const auto word : words_)
            count += static_cast<std::size_t>(__builtin_popcountll(word));
        return count;
    }
    /** The first vertex at or after `from`; none: beyond all. */
    std::size_t first_from(std::size_t from) const
    {
        for (std::size_t i = from / kBits; i < words_.size(); ++i)
        {
            const auto word =
                i == from / kBits ? words_[i] & (~std::uint64_t{0} << (from % kBits)) : words_[i];
            if (word != 0) return i * kBits + static_cast<std::size_t>(__builtin_ctzll(word));
        }
        return words_.size() * kBits;
    }
    VertexSet& operator&=(const VertexSet& other)
    {
        for (std::size_t i = 0; i < words_.size(); ++i) words_[i] &= other.words_[i];
        return *this;
    }
    void remove(const VertexSet& other)
    {
        for (std::size_t i = 0; i < words_.size(); ++i) words_[i] &= ~other.words_[i];
    }
    std::size_t end() const { return words_.size() * kBits; }

 private:
    static constexpr std::size_t kBits = 64;
    static std::uint64_t bit(std::size_t vertex) { return std::uint64_t{1} << (vertex % kBits); }

    std::vector<std::uint64_t> words_;
};

/** A vertex and an upper bound of the cliques among it and those before it. */
struct Coloured
{
    std::size_t vertex = 0;
    std::size_t colours = 0;
};

class CliqueSearch
{
 public:
    CliqueSearch(std::vector<VertexSet> neighbours,
                 std::size_t max_steps,
                 const CheckCancelled& check_cancelled)
        : neighbours_(std::move(neighbours)),
          steps_left_(max_steps),
          check_cancelled_(check_cancelled)
    {
    }

    Clique run()
    {
        VertexSet all(neighbours_.size());
        for (std::size_t i = 0; i < neighbours_.size(); ++i) all.insert(i);
        const auto coloured = colour(all);
        best_ = greedy(all);
        const std::size_t bound = coloured.empty() ? 0 : coloured.back().colours;
        std::vector<std::size_t> chosen;
        expand(chosen, all);
        return {best_, steps_left_ == 0 ? bound : best_.size()};
    }

 private:
    /** Vertices in order of growing number of colours: no two of a colour are joined. */
    std::vector<Coloured> colour(VertexSet left) const
    {
        std::vector<Coloured> order;
        order.reserve(left.size());
        for (std::size_t colours = 1; !left.empty(); ++colours)
        {
            auto candidates = left;
            for (auto v = candidates.first_from(0); v < candidates.end();
                 v = candidates.first_from(v + 1))
            {
                candidates.remove(neighbours_[v]);
                left.erase(v);
                order.push_back({v, colours});
            }
        }
        return order;
    }

    /** Takes the vertex with most neighbours left, again and again. */
    std::vector<std::size_t> greedy(VertexSet left) const
    {
        std::vector<std::size_t> clique;
        while (!left.empty())
        {
            check_cancelled_();
            std::size_t best = left.end();
            std::size_t most = 0;
            for (auto v = left.first_from(0); v < left.end(); v = left.first_from(v + 1))
            {
                auto joined = left;
                const auto count = (joined &= neighbours_[v]).size();
                if (best != left.end() && count <= most) continue;
                best = v;
                most = count;
            }
            clique.push_back(best);
            left &= neighbours_[best];
        }
        return clique;
    }

    void expand(std::vector<std::size_t>& chosen, VertexSet left)
    {
        if (chosen.size() > best_.size()) best_ = chosen;
        const auto order = colour(left);
        for (std::size_t i = order.size(); i-- > 0;)
        {
            if (chosen.size() + order[i].colours <= best_.size() || steps_left_ == 0) return;
            check_cancelled_();
            --steps_left_;
            auto remaining = left;
            remaining &= neighbours_[order[i].vertex];
            chosen.push_back(order[i].vertex);
            expand(chosen, std::move(remaining));
            chosen.pop_back();
            left.erase(order[i].vertex);
        }
    }

    std::vector<VertexSet> neighbours_;
    std::size_t steps_left_;
    const CheckCancelled& check_cancelled_;
    std::vector<std::size_t> best_;
};

void check(const std::vector<std::vector<bool>>& adjacency)
{
    for (std::size_t i = 0; i < adjacency.size(); ++i)
    {
        if (adjacency[i].size() != adjacency.size())
            throw std::invalid_argument("largest_clique: the adjacency matrix is not square");
        for (std::size_t j = 0; j < i; ++j)
            if (adjacency[i][j] != adjacency[j][i])
                throw std::invalid_argument(
                    "largest_clique: the adjacency matrix is not symmetric");
    }
}

/** Vertices with many neighbours first: their colours are tried first. */
std::vector<std::size_t> by_degree(const std::vector<std::vector<bool>>& adjacency)
{
    std::vector<std::ptrdiff_t> degrees;
    degrees.reserve(adjacency.size());
    for (const auto& row : adjacency) degrees.push_back(std::count(row.begin(), row.end(), true));
    std::vector<std::size_t> order(adjacency.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(),
                     order.end(),
                     [&](std::size_t a, std::size_t b) { return degrees[a] > degrees[b]; });
    return order;
}
}  // namespace

Clique largest_clique(const std::vector<std::vector<bool>>& adjacency,
                      const CheckCancelled& check_cancelled,
                      std::size_t max_steps)
{
    check(adjacency);
    const auto order = by_degree(adjacency);
    std::vector<VertexSet> neighbours(order.size(), VertexSet(order.size()));
    for (std::size_t i = 0; i < order.size(); ++i)
        for (std::size_t j = 0; j < order.size(); ++j)
            if (i != j && adjacency[order[i]][order[j]]) neighbours[i].insert(j);
    auto clique = CliqueSearch(std::move(neighbours), max_steps, check_cancelled).run();
    for (auto& vertex : clique.vertices) vertex = order[vertex];
    std::sort(clique.vertices.begin(), clique.vertices.end());
    return clique;
}

}  // namespace fild
