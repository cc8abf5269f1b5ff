// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/descriptors.h"
#include "fild/features/global_descriptor_options.h"

#include <opencv2/core/mat.hpp>

#include <memory>

namespace fild
{
class Network;

/** What the network tells of an image. */
struct ImageAppearance
{
    GlobalDescriptor global;
    CellFeatures cells;  ///< none: options.cell_layer is empty
};

/** Appearance of a whole image by a convolutional network, MobileNetV2 in FILD (IROS 2019) section
 *  III-A: one or more layers' outputs, pooled and normalised. Batch normalisation is merged with
 *  the convolutions, Eq. (1) to (3).
 *
 *  Deterministic for a given kind of processor; other kinds round differently, in the last digits
 *  with Precision::f32. Backend::onednn works in the thread that calls it. Backend::opencv takes
 *  cv::getNumThreads() threads, by which it splits its sums: the last digits depend on their
 *  number. Not thread-safe: one caller at a time. */
class GlobalDescriptorExtractor
{
 public:
    /** Loads the network and runs it once on a black image, so that a wrong model fails here.
     *  \throw std::runtime_error when the model file is missing (naming the command that gets it) or
     *         not a model, when it lacks a wanted layer, or when its descriptor has another length
     *         than options.dimension; with Backend::onednn also when it has a layer of an unsupported
     *         kind, or when bf16 is asked for and the processor does not have it. */
    explicit GlobalDescriptorExtractor(const TGlobalDescriptorOptions& options);
    ~GlobalDescriptorExtractor();
    GlobalDescriptorExtractor(GlobalDescriptorExtractor&&) noexcept;
    GlobalDescriptorExtractor& operator=(GlobalDescriptorExtractor&&) noexcept;

    /** \param image 8 bit, one channel (grey) or three (BGR), any size but empty.
     *  \return `global`: dimension() numbers of unit norm; all zero when all activations are.
     *  \throw std::invalid_argument on another kind of image. */
    ImageAppearance extract(const cv::Mat& image);

    std::size_t dimension() const { return dimension_; }

 private:
    ImageAppearance forward(const cv::Mat& image);

    TGlobalDescriptorOptions options_;
    std::unique_ptr<Network> network_;
    std::size_t dimension_ = 0;
};

}  // namespace fild
