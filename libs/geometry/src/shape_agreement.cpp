// SPDX-License-Identifier: BSD-3-Clause
#include "fild/geometry/shape_agreement.h"

#include <cstdlib>

namespace fild
{
namespace
{
constexpr double kDegreesPerTurn = 360;

/** Rotation and scale of one match, in the steps of DominantShape. */
struct ShapeChange
{
    int angle = 0;  ///< in [-128, 128)
    int size = 0;
};

int wrapped(int angle_steps)
{
    constexpr int kHalf = KeypointShape::kStepsPerTurn / 2;
    return ((angle_steps + kHalf) & (KeypointShape::kStepsPerTurn - 1)) - kHalf;
}

ShapeChange change_of(const Match& match,
                      const std::vector<KeypointShape>& query,
                      const std::vector<KeypointShape>& candidate)
{
    const auto& from = query[match.query];
    const auto& to = candidate[match.candidate];
    return {wrapped(int{to.angle} - int{from.angle}), int{to.size} - int{from.size}};
}

class Agreement
{
 public:
    explicit Agreement(const ShapeTolerance& tolerance)
        : angle_steps_(static_cast<int>(tolerance.angle_deg / kDegreesPerTurn *
                                        KeypointShape::kStepsPerTurn)),
          size_steps_(static_cast<int>(tolerance.octaves * KeypointShape::kStepsPerOctave))
    {
    }

    bool operator()(const ShapeChange& a, const ShapeChange& b) const
    {
        return std::abs(wrapped(a.angle - b.angle)) <= angle_steps_ &&
               std::abs(a.size - b.size) <= size_steps_;
    }

 private:
    int angle_steps_;
    int size_steps_;
};

std::vector<ShapeChange> changes_of(const std::vector<Match>& matches,
                                    const std::vector<KeypointShape>& query,
                                    const std::vector<KeypointShape>& candidate)
{
    std::vector<ShapeChange> changes;
    changes.reserve(matches.size());
    for (const auto& match : matches) changes.push_back(change_of(match, query, candidate));
    return changes;
}
}  // namespace

DominantShape dominant_shape(const std::vector<Match>& matches,
                             const std::vector<KeypointShape>& query,
                             const std::vector<KeypointShape>& candidate,
                             const ShapeTolerance& tolerance)
{
    const Agreement agree(tolerance);
    const auto changes = changes_of(matches, query, candidate);
    DominantShape dominant;
    for (const auto& centre : changes)
    {
        std::size_t agreeing = 0;
        for (const auto& change : changes) agreeing += agree(change, centre) ? 1U : 0U;
        if (agreeing > dominant.agreeing) dominant = {centre.angle, centre.size, agreeing};
    }
    return dominant;
}

std::vector<std::size_t> indices_of_shape(const DominantShape& shape,
                                          const std::vector<Match>& matches,
                                          const std::vector<KeypointShape>& query,
                                          const std::vector<KeypointShape>& candidate,
                                          const ShapeTolerance& tolerance)
{
    const Agreement agree(tolerance);
    std::vector<std::size_t> kept;
    for (std::size_t k = 0; k < matches.size(); ++k)
        if (agree(change_of(matches[k], query, candidate), {shape.angle_steps, shape.size_steps}))
            kept.push_back(k);
    return kept;
}

}  // namespace fild
