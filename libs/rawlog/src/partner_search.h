// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <deque>
#include <memory>
#include <optional>
#include <vector>

namespace mrpt::obs
{
class CObservationImage;
}

namespace fild
{
using SingleImage = std::shared_ptr<mrpt::obs::CObservationImage>;

enum class StereoSide
{
    left,
    right
};

/** A left image and its right one, which may be missing. */
struct ImagePair
{
    SingleImage left;
    SingleImage right;
};

/** Finds the right image of each left one, by their time stamps, see StereoPairing. At most eight
 *  images of each side wait. Not thread-safe: one caller at a time. */
class PartnerSearch
{
 public:
    explicit PartnerSearch(double tolerance_seconds) : tolerance_(tolerance_seconds) {}

    /** \return the left images that wait no longer, in the order they came. */
    std::vector<ImagePair> add(StereoSide side, const SingleImage& image);

    /** The left images that still wait. */
    std::vector<ImagePair> finish();

    /** Left images with a partner, and without; right images without. */
    std::size_t paired() const { return paired_; }
    std::size_t left_alone() const { return left_.alone; }
    std::size_t right_alone() const { return right_.alone; }

    /** Images of each side since the last pair. */
    std::size_t left_since_pair() const { return left_.since_pair; }
    std::size_t right_since_pair() const { return right_.since_pair; }

    /** Time stamp of the latest image of a side, seconds. */
    std::optional<double> last_left() const { return left_.last; }
    std::optional<double> last_right() const { return right_.last; }

    /** How far the right image that is nearest in time usually is from a left one without partner,
     *  seconds; nothing when there was none. */
    std::optional<double> usual_miss() const;

    /** Half the usual time between two left images: more cannot be told apart. */
    std::optional<double> largest_tolerance() const;

 private:
    struct Waiting
    {
        SingleImage image;
        double seconds = 0;
        std::optional<double> nearest;  ///< difference to an image of the other side
    };
    using Queue = std::deque<Waiting>;
    struct Side
    {
        Queue queue;
        std::optional<double> last;  ///< time stamp, seconds
        std::size_t alone = 0;
        std::size_t since_pair = 0;
    };

    double tolerance() const;
    void note_time(StereoSide side, double seconds);
    /** The image of the other side nearest in time, if it is near enough. */
    static std::optional<std::size_t> nearest_in(const Queue& queue,
                                                 double seconds,
                                                 double tolerance);
    void give_up(StereoSide side, std::size_t count, std::vector<ImagePair>& done);
    void give_up_hopeless(std::vector<ImagePair>& done);

    Side& side_of(StereoSide side) { return side == StereoSide::left ? left_ : right_; }

    double tolerance_;
    Side left_;
    Side right_;
    std::deque<double> left_gaps_;  ///< the latest, seconds
    std::vector<double> misses_;
    std::size_t paired_ = 0;
};

}  // namespace fild
