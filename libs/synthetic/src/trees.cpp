// SPDX-License-Identifier: BSD-3-Clause
#include "trees.h"

#include "solids.h"

#include <mrpt/opengl/COpenGLScene.h>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace fild
{
namespace
{
/** Ranges of the blue, green and red of a leaf. */
struct LeafColour
{
    cv::Vec2d blue;
    cv::Vec2d green;
    cv::Vec2d red;
    Colour shade;  ///< between the leaves
};

const std::array<LeafColour, kAutumnColours + 1>& leaf_colours()
{
    static const std::array<LeafColour, kAutumnColours + 1> colours{
        LeafColour{{25, 60}, {85, 135}, {50, 105}, {18, 38, 26}},
        LeafColour{{20, 60}, {130, 190}, {160, 225}, {15, 50, 62}},
        LeafColour{{20, 50}, {55, 105}, {120, 190}, {14, 26, 48}}};
    return colours;
}

/** Leaves; darker towards the lower edge, where a crown is in its own shade. */
cv::Mat paint_leaves(const LeafColour& colour)
{
    constexpr int kSide = 512;
    constexpr int kLeaves = 9000;
    Lot lot(61);
    cv::Mat leaves(kSide, kSide, CV_8UC3, scalar(colour.shade));
    for (int i = 0; i < kLeaves; ++i)
    {
        const cv::Point at(lot.whole(0, kSide - 1), lot.whole(0, kSide - 1));
        const auto light = (1.3 - 0.9 * at.y / kSide) * lot.real(0.7, 1.3);
        const Colour leaf(lot.real(colour.blue[0], colour.blue[1]),
                          lot.real(colour.green[0], colour.green[1]),
                          lot.real(colour.red[0], colour.red[1]));
        cv::ellipse(leaves,
                    at,
                    cv::Size(lot.whole(4, 9), lot.whole(2, 4)),
                    lot.real(0, 180),
                    0,
                    360,
                    scalar(brighter(leaf, light)),
                    cv::FILLED,
                    cv::LINE_AA);
    }
    return leaves;
}

/** A lumpy ball of leaves. */
void add_crown(TexturedMesh& mesh, const cv::Point3d& centre, double radius, Lot& lot)
{
    constexpr int kAround = 10;
    constexpr int kUp = 7;
    std::array<std::array<double, kAround + 1>, kUp + 1> lumps{};
    for (auto& ring : lumps)
    {
        for (auto& lump : ring) lump = radius * lot.real(0.78, 1.12);
        ring.back() = ring.front();
    }
    lumps.front().fill(radius);
    lumps.back().fill(radius);
    const auto turn = lot.real(0, 1);
    const auto direction = [](int around, int up)
    {
        const auto azimuth = 2 * CV_PI * around / kAround;
        const auto polar = CV_PI * up / kUp;
        return cv::Point3d(std::sin(polar) * std::cos(azimuth),
                           std::sin(polar) * std::sin(azimuth),
                           -std::cos(polar));
    };
    const auto corner = [&](int around, int up)
    {
        const auto lump = lumps[static_cast<std::size_t>(up)][static_cast<std::size_t>(around)];
        return Corner{centre + lump * direction(around, up),
                      {turn + 1.5 * radius * around / kAround, 0.98 - 0.96 * up / kUp}};
    };
    for (int up = 0; up < kUp; ++up)
        for (int around = 0; around < kAround; ++around)
        {
            const int next = around + 1;
            mesh.add_smooth_triangle(
                {corner(around, up), corner(next, up), corner(next, up + 1)},
                {direction(around, up), direction(next, up), direction(next, up + 1)});
            mesh.add_smooth_triangle(
                {corner(around, up), corner(next, up + 1), corner(around, up + 1)},
                {direction(around, up), direction(next, up + 1), direction(around, up + 1)});
        }
}

/** Meshes of all trees. */
struct TreeMeshes
{
    TexturedMesh wood;
    std::array<TexturedMesh, kAutumnColours + 1> crowns;
};

/** Bent branches with twigs that spread from the top of the trunk. */
void add_branches(TexturedMesh& wood, const PlaceFrame& frame, double height, Lot& lot)
{
    const cv::Rect2d bark(0, 0, 0.3, 1);
    const auto branches = lot.whole(6, 9);
    for (int i = 0; i < branches; ++i)
    {
        const auto azimuth = 2 * CV_PI * (i + lot.real(-0.3, 0.3)) / branches;
        const auto out = lot.real(0.5, 1.3);
        const auto rise = lot.real(0.9, 2.2);
        const auto along = [&](double share)
        {
            const auto bent = out * std::sqrt(share);
            return frame.at(
                bent * std::cos(azimuth), bent * std::sin(azimuth), height - 0.2 + rise * share);
        };
        add_limb(wood, {{along(0), 0.07}, {along(0.5), 0.045}, {along(1), 0.012}}, bark);
        const auto twigs = lot.whole(4, 7);
        for (int k = 0; k < twigs; ++k)
        {
            const auto root = along(lot.real(0.25, 1));
            const cv::Point3d tip(lot.real(-0.5, 0.5), lot.real(-0.5, 0.5), lot.real(0.1, 0.6));
            add_limb(wood, {{root, 0.018}, {root + tip, 0.005}}, bark);
        }
    }
}

void add_tree(TreeMeshes& meshes, const StandingObject& tree, const Foliage& foliage)
{
    Lot lot(tree.seed);
    const PlaceFrame frame(tree, kKerbHeight);
    const auto height = lot.real(2.4, 3.2);
    add_post(meshes.wood, frame, {0, 0}, {0, height + 0.5}, lot.real(0.1, 0.2), 8);
    const auto clumps = lot.whole(4, 7);
    auto& crowns = meshes.crowns.at(static_cast<std::size_t>(foliage.colour));
    const bool is_full = foliage.density == 1;
    const auto crown_clumps =
        is_full ? clumps : static_cast<int>(std::lround(3 * clumps * foliage.density));
    const auto size = is_full ? 1 : 0.35 + 0.3 * foliage.density;
    for (int i = 0; i < crown_clumps; ++i)
        add_crown(crowns,
                  frame.at(lot.real(-0.8, 0.8), lot.real(-0.7, 0.7), height + lot.real(0.2, 1.9)),
                  lot.real(0.6, 1.15) * size,
                  lot);
    if (foliage.density < 1) add_branches(meshes.wood, frame, height, lot);
}
}  // namespace

Foliage foliage_of(const StandingObject& tree, double season)
{
    if (season <= 0) return {};
    Lot lot(tree.seed + 1);
    Foliage foliage;
    foliage.density = std::clamp(1.25 - season * lot.real(0.4, 1.6), 0.0, 1.0);
    const auto colour = lot.whole(1, kAutumnColours);
    if (lot.chance(season)) foliage.colour = colour;
    return foliage;
}

void add_trees(mrpt::opengl::COpenGLScene& scene,
               const std::vector<StandingObject>& trees,
               double season)
{
    TreeMeshes meshes;
    for (const auto& tree : trees) add_tree(meshes, tree, foliage_of(tree, season));
    Lot lot(62);
    scene.insert(meshes.wood.object(paint_mottled({128, 256}, {55, 75, 95}, 0.25, lot)));
    for (std::size_t i = 0; i < meshes.crowns.size(); ++i)
        if (!meshes.crowns.at(i).empty())
            scene.insert(meshes.crowns.at(i).object(paint_leaves(leaf_colours().at(i))));
}

}  // namespace fild
