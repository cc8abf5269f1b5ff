// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace fild
{
/** Appearance of a whole image, of unit L2 norm, so that the scalar product of two is the cosine
 *  similarity of FILD (IROS 2019) Eq. (4). All descriptors of a run have the same length. */
using GlobalDescriptor = std::vector<float>;

/** Where a local feature sits. Pixels; the centre of the upper left pixel is (0, 0). */
struct Keypoint
{
    float x = 0;
    float y = 0;
    float size = 0;  ///< diameter of the feature, pixels
    float angle = 0;  ///< orientation, radians in [0, 2 pi), from the x axis towards the y axis
    float response = 0;  ///< determinant of the Hessian
};

struct ImageSize
{
    int width = 0;  ///< pixels
    int height = 0;  ///< pixels
};

/** Keypoints of an image and their descriptors, row i of `descriptors` (keypoints.size() x
 * dimension, row-major, each of unit L2 norm) belonging to keypoints[i]. */
struct LocalFeatures
{
    static constexpr std::size_t dimension = 128;

    std::vector<Keypoint> keypoints;
    std::vector<float> descriptors;
    ImageSize image_size;

    std::size_t size() const { return keypoints.size(); }
    const float* descriptor(std::size_t i) const { return descriptors.data() + i * dimension; }
};

/** What is typical of local descriptors: LocalFeatures::dimension numbers each. */
struct DescriptorStatistics
{
    std::vector<float> mean;
    std::vector<float> deviation;
};

/** Position of a keypoint in its image, pixels. */
struct PixelPosition
{
    float x = 0;
    float y = 0;
};

/** Size and orientation of a keypoint in two bytes, which is what the map keeps of them. */
struct KeypointShape
{
    static constexpr int kStepsPerOctave = 16;
    static constexpr int kStepsPerTurn = 256;

    std::uint8_t size = 0;  ///< kStepsPerOctave x log2 of the diameter in pixels
    std::uint8_t angle = 0;  ///< kStepsPerTurn-ths of a turn, from the x axis towards the y axis
};

/** Rounded; sizes below 1 pixel count as 1. */
KeypointShape shape_of(const Keypoint& keypoint);

/** Two pixels taken for the same point of the scene. */
struct PixelPair
{
    PixelPosition query;
    PixelPosition candidate;
};

/** Binary codes of one image's local descriptors, code i in words [i * words_per_code, ...).
 *  Bits beyond `bits` in the last word are 0. `buckets` holds, for every code, one coarse bucket
 *  number a hash table (empty when the coarse step is off). */
struct BinaryCodes
{
    int bits = 0;
    int words_per_code = 0;
    int tables = 0;
    std::vector<std::uint64_t> words;
    std::vector<std::uint16_t> buckets;

    std::size_t size() const { return words_per_code == 0 ? 0 : words.size() / stride(); }
    const std::uint64_t* code(std::size_t i) const { return words.data() + i * stride(); }
    const std::uint16_t* bucket(std::size_t i) const
    {
        return buckets.data() + i * static_cast<std::size_t>(tables);
    }

 private:
    std::size_t stride() const { return static_cast<std::size_t>(words_per_code); }
};

/** Hamming distance of two codes of `words` words, bits. */
int hamming_distance(const std::uint64_t* a, const std::uint64_t* b, std::size_t words);

/** What a layer of the network sees in each cell of an image: `channels` numbers a cell, the cells
 *  row by row. Of each channel the mean over the image is 0 and the deviation 1, so that light and
 *  colour of a whole image do not count. */
struct CellFeatures
{
    int rows = 0;
    int columns = 0;
    int channels = 0;
    std::vector<float> values;

    std::size_t size() const
    {
        return static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns);
    }
};

/** The binary codes of an image's cells, row by row. */
struct CellCodes
{
    int rows = 0;
    int columns = 0;
    BinaryCodes codes;
};

/** What the map keeps of a frame for the verification of later loops. Keypoint i has position i,
 *  shape i and code i; the strongest keypoints come first. */
struct HashedFeatures
{
    std::vector<PixelPosition> positions;
    BinaryCodes codes;
    std::vector<KeypointShape> shapes{};
    ImageSize image_size{};
    CellCodes cells{};  ///< none: [global_descriptor] cell_layer is empty
};

/** Two local features taken for the same point of the scene. */
struct Match
{
    std::size_t query = 0;  ///< index into the query frame's features
    std::size_t candidate = 0;  ///< index into the candidate frame's features
    int distance_bits = 0;  ///< Hamming distance of their codes
};

}  // namespace fild
