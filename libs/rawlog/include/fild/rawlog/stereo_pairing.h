// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/rawlog/input_options.h"

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace mrpt::obs
{
class CObservation;
}

namespace fild
{
/** What became of the images of two cameras that are a stereo pair. Value type. */
struct StereoPairReport
{
    StereoLabels labels;
    std::size_t paired = 0;  ///< left images with a right one
    std::size_t left_alone = 0;  ///< frames without a right image
    std::size_t right_alone = 0;  ///< right images that are in no frame
};

/** What the user should know of a camera that has a partner, or could have. Value type. */
struct StereoPairNote
{
    std::string label;  ///< of the camera that the pair lacks
    std::string text;
};

/** Makes a stereo camera of two that record one by one: a CObservationImage of each becomes one
 *  CObservationStereoImages with the label, time stamp and pose of the left one, which FrameBuilder
 *  takes as any other.
 *
 *  The cameras are those that [input] stereo_labels names. Without names they are the first two
 *  calibrated cameras that look the same way, to 20 degrees, from places beside each other (see
 *  is_usable_baseline()), with images within stereo_tolerance_seconds; the left one must be one
 *  that sensor_label takes. Until such two are found, up to four images of each calibrated camera
 *  are held back; after that all go on as they are, until two are found.
 *
 *  A left image and a right one belong together when their stamps differ by no more than the
 *  tolerance, and by no more than half the usual time between two left images; of several the
 *  nearest. Either may come first. A left image whose right one cannot come any more, or waits
 *  behind eight others, becomes a CObservationStereoImages without a right image (before the right
 *  camera was seen, it goes on as it is); a right image alone is dropped. Embedded images are
 *  shared, not copied.
 *  Deterministic. Not thread-safe: one caller at a time. */
class StereoPairing
{
 public:
    using Observations = std::vector<std::shared_ptr<mrpt::obs::CObservation>>;

    /** \throw std::invalid_argument on bad options. */
    explicit StereoPairing(const TInputOptions& options);
    StereoPairing(const StereoPairing&) = delete;
    StereoPairing& operator=(const StereoPairing&) = delete;
    ~StereoPairing();

    /** True for an observation that feed() is to see: a CObservationImage, unless pairing is off.
     *  */
    bool takes(const mrpt::obs::CObservation& observation) const;

    /** \param observation  that takes() is true for. Its image must not be changed afterwards.
     *  \return what goes on, in order: pairs, and images of other cameras.
     *  \throw std::runtime_error when the cameras named stand the other way round. */
    Observations feed(const mrpt::obs::CObservation& observation);

    /** At the end of the recording: what still waits. */
    Observations finish();

    /** Nothing when no two cameras are a pair. */
    std::optional<StereoPairReport> report() const;

    /** For the user, after finish(): why images have no partner, or two cameras are no pair, and
     *  what to do. */
    std::vector<StereoPairNote> notes() const;

 private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace fild
