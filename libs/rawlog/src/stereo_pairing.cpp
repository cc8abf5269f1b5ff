// SPDX-License-Identifier: BSD-3-Clause
#include "fild/rawlog/stereo_pairing.h"

#include "camera_labels.h"
#include "camera_view.h"
#include "fild/core/utf8.h"
#include "fild/rawlog/camera_conversion.h"
#include "pair_candidates.h"
#include "pair_notes.h"
#include "paired_images.h"
#include "partner_search.h"

#include <mrpt/obs/CObservationImage.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace fild
{
namespace
{
using mrpt::obs::CObservation;
using mrpt::obs::CObservationImage;
using mrpt::poses::CPose3D;
using mrpt::poses::CPose3DQuat;
using Observations = StereoPairing::Observations;

const TInputOptions& checked_for_pairs(const TInputOptions& options)
{
    options.check();
    return options;
}

std::string label_of(const CObservation& observation)
{
    return as_utf8(observation.sensorLabel);
}

/** \param right_camera  where the right camera is and how it is calibrated; null while that is not
 *  known. \param pair  with a right image or without. */
CObservation::Ptr stereo_of(const ImagePair& pair, const SingleImage& right_camera)
{
    if (!right_camera) return pair.left;
    auto stereo = std::make_shared<CPairedImages>();
    stereo->sensorLabel = pair.left->sensorLabel;
    stereo->timestamp = pair.left->timestamp;
    stereo->imageLeft = pair.left->image;
    stereo->leftCamera = pair.left->cameraParams;
    stereo->cameraPose = CPose3DQuat(pair.left->cameraPose);
    stereo->hasImageRight = pair.right != nullptr;
    if (pair.right)
    {
        stereo->imageRight = pair.right->image;
        stereo->right_seconds_later = mrpt::Clock::toDouble(pair.right->timestamp) -
                                      mrpt::Clock::toDouble(pair.left->timestamp);
    }
    stereo->rightCamera = right_camera->cameraParams;
    stereo->rightCameraPose = CPose3DQuat(right_camera->cameraPose - pair.left->cameraPose);
    return stereo;
}

/** The image without its pixels. */
SingleImage camera_of(const CObservationImage& image)
{
    auto camera = CObservationImage::Create();
    camera->sensorLabel = image.sensorLabel;
    camera->cameraParams = image.cameraParams;
    camera->cameraPose = image.cameraPose;
    return camera;
}
}  // namespace

/** Two cameras, known to be a pair or named. */
struct KnownPair
{
    KnownPair(const StereoLabels& of, double tolerance) : labels(of), partners(tolerance) {}

    StereoLabels labels;
    PartnerSearch partners;
    SingleImage left_camera;  ///< the latest, without pixels
    SingleImage right_camera;
    PairFit fit = PairFit::first_is_left;
};

struct StereoPairing::State
{
    explicit State(const TInputOptions& checked_options)
        : options(checked_options),
          labels(options),
          candidates(!options.camera_parameters.empty(), options.stereo_tolerance_seconds)
    {
        if (const auto named = options.named_pair())
            pair.emplace(*named, options.stereo_tolerance_seconds);
    }

    Observations feed_image(const SingleImage& image);
    /** As feed_image(), while no two cameras are known to be a pair. */
    Observations search(const std::string& label, const SingleImage& image);
    bool is_calibrated(const CObservationImage& image) const;
    bool holds_too_many(const std::string& label) const;
    /** An image that is not one of a pair goes on as it is. */
    void pass_on(const SingleImage& image, Observations& out);
    void add_to_pair(StereoSide side, const SingleImage& image, Observations& out);
    /** \throw std::runtime_error when the right camera stands to the left. */
    void check_named_pair();
    Observations release_held();

    TInputOptions options;
    CameraLabels labels;
    PairCandidates candidates;
    std::vector<SingleImage> held;  ///< until two cameras are known to be a pair
    bool is_holding = true;
    std::optional<KnownPair> pair;
    bool is_checked = false;  ///< the pair named
};

bool StereoPairing::State::is_calibrated(const CObservationImage& image) const
{
    return !options.camera_parameters.empty() || camera_model_from(image.cameraParams).has_value();
}

bool StereoPairing::State::holds_too_many(const std::string& label) const
{
    constexpr std::ptrdiff_t kMostHeld = 4;
    return std::count_if(held.begin(),
                         held.end(),
                         [&](const SingleImage& image)
                         { return label_of(*image) == label; }) > kMostHeld;
}

void StereoPairing::State::pass_on(const SingleImage& image, Observations& out)
{
    labels.accepts_camera(label_of(*image));
    out.push_back(image);
}

Observations StereoPairing::State::release_held()
{
    is_holding = false;
    Observations out;
    for (const auto& image : held) pass_on(image, out);
    held.clear();
    return out;
}

void StereoPairing::State::check_named_pair()
{
    if (is_checked || !pair->left_camera || !pair->right_camera) return;
    is_checked = true;
    pair->fit =
        fit_of_pair(*pair->left_camera, *pair->right_camera, !options.camera_parameters.empty());
    const auto& [left, right] = pair->labels;
    if (pair->fit == PairFit::second_is_left)
        throw std::runtime_error(
            "by their poses on the robot camera '" + right + "' stands to the left of '" + left +
            "'; set [input] stereo_labels = " + right + "," + left +
            ", or correct the poses in the rawlog, or set stereo_labels = none");
}

void StereoPairing::State::add_to_pair(StereoSide side, const SingleImage& image, Observations& out)
{
    (side == StereoSide::left ? pair->left_camera : pair->right_camera) = camera_of(*image);
    check_named_pair();
    for (const auto& done : pair->partners.add(side, image))
        out.push_back(stereo_of(done, done.right ? done.right : pair->right_camera));
}

Observations StereoPairing::State::search(const std::string& label, const SingleImage& image)
{
    for (const auto& found : candidates.add(label, image))
        if (labels.could_want(found.left) && !pair)
            pair.emplace(found, options.stereo_tolerance_seconds);
    if (pair)
    {
        is_checked = true;
        auto before = std::exchange(held, {});
        before.push_back(image);
        Observations out;
        for (const auto& each : before)
            for (auto& observation : feed_image(each)) out.push_back(std::move(observation));
        return out;
    }
    const bool can_wait = is_holding && is_calibrated(*image);
    if (can_wait) held.push_back(image);
    if (can_wait && !holds_too_many(label)) return {};
    auto out = release_held();
    if (!can_wait) pass_on(image, out);
    return out;
}

Observations StereoPairing::State::feed_image(const SingleImage& image)
{
    const auto label = label_of(*image);
    if (!pair) return search(label, image);
    Observations out;
    if (label == pair->labels.left)
        add_to_pair(StereoSide::left, image, out);
    else if (label == pair->labels.right)
        add_to_pair(StereoSide::right, image, out);
    else
        pass_on(image, out);
    return out;
}

StereoPairing::StereoPairing(const TInputOptions& options)
    : state_(std::make_unique<State>(checked_for_pairs(options)))
{
}

StereoPairing::~StereoPairing() = default;

bool StereoPairing::takes(const CObservation& observation) const
{
    const auto& options = state_->options;
    return (options.finds_pairs() || options.named_pair()) &&
           dynamic_cast<const CObservationImage*>(&observation) != nullptr;
}

Observations StereoPairing::feed(const CObservation& observation)
{
    if (takes(observation))
        return state_->feed_image(
            CObservationImage::Create(dynamic_cast<const CObservationImage&>(observation)));
    if (!camera_view_of(observation)) return {};
    auto before = state_->release_held();
    state_->labels.accepts_camera(label_of(observation));
    return before;
}

Observations StereoPairing::finish()
{
    auto out = state_->release_held();
    if (!state_->pair) return out;
    auto& pair = *state_->pair;
    for (const auto& done : pair.partners.finish())
        out.push_back(stereo_of(done, pair.right_camera));
    return out;
}

std::optional<StereoPairReport> StereoPairing::report() const
{
    if (!state_->pair) return std::nullopt;
    const auto& partners = state_->pair->partners;
    return StereoPairReport{
        state_->pair->labels, partners.paired(), partners.left_alone(), partners.right_alone()};
}

std::vector<StereoPairNote> StereoPairing::notes() const
{
    const auto& pair = state_->pair;
    if (!pair)
        return notes_on_trials(state_->candidates.trials(),
                               state_->options.stereo_tolerance_seconds,
                               [this](const std::string& label)
                               { return state_->labels.could_want(label); });
    const bool has_left = pair->left_camera && state_->is_calibrated(*pair->left_camera);
    return notes_on_pair({pair->labels,
                          pair->partners,
                          pair->fit,
                          has_left ? pair->labels.right : pair->labels.left,
                          pair->right_camera != nullptr},
                         state_->options.stereo_tolerance_seconds);
}

}  // namespace fild
