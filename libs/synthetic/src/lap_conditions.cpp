// SPDX-License-Identifier: BSD-3-Clause
#include "fild/synthetic/lap_conditions.h"

#include "lot.h"
#include "seeded_generator.h"

#include <opencv2/imgproc.hpp>

#include <cmath>
#include <random>
#include <stdexcept>

namespace fild
{
namespace
{
constexpr double kMaxAzimuthChange = 1.5707963267948966;  // rad
constexpr double kMaxElevationChange = 0.5;  // rad: the sun stays well over the horizon

/** In [0.5, 1) or (-1, -0.5]. */
double distinct_change(Lot& lot)
{
    const double size = lot.real(0.5, 1);
    return lot.chance(0.5) ? -size : size;
}

/** Nearly normal noise from one random number a value, an order of magnitude faster than
 *  standard_normal(): the sum of four uniform ones (its largest value is 3.5 deviations). */
class PixelNoise
{
 public:
    explicit PixelNoise(double deviation, std::mt19937_64 generator)
        : factor_(deviation / std::sqrt((65536.0 * 65536.0 - 1) / 3)), generator_(generator)
    {
    }

    double next()
    {
        constexpr std::uint64_t kMask = 0xFFFF;
        constexpr double kMean = 2 * 65535.0;
        const std::uint64_t bits = generator_();
        const std::uint64_t sum =
            (bits & kMask) + ((bits >> 16U) & kMask) + ((bits >> 32U) & kMask) + (bits >> 48U);
        return factor_ * (static_cast<double>(sum) - kMean);
    }

 private:
    double factor_;
    std::mt19937_64 generator_;
};

void add_noise(cv::Mat& image, PixelNoise noise)
{
    for (int row = 0; row < image.rows; ++row)
    {
        auto* values = image.ptr<uchar>(row);
        for (int i = 0; i < image.cols * image.channels(); ++i)
            values[i] = cv::saturate_cast<uchar>(values[i] + noise.next());
    }
}
}  // namespace

void TConditionsOptions::describe(OptionVisitor& visitor)
{
    visitor.real("light_change", light_change, 0, 1);
    visitor.flag("parked_cars_change", parked_cars_change);
    visitor.real("occluders", occluders, 0, 1);
    visitor.real("season_change", season_change, 0, 1);
    visitor.real("image_noise", image_noise, 0, 100);
    visitor.real("blur_px", blur_px, 0, 10);
}

LapConditions conditions_of_lap(const TConditionsOptions& options, int lap, std::uint64_t seed)
{
    options.check();
    LapConditions conditions;
    const int lap_of_cars = options.parked_cars_change ? lap : 0;
    conditions.parked_cars = seeded_generator(
        seed, RandomPurpose::parked_cars, static_cast<std::uint64_t>(lap_of_cars))();
    if (lap == 0) return conditions;
    Lot lot(seeded_generator(seed, RandomPurpose::light, static_cast<std::uint64_t>(lap))());
    const double change = options.light_change;
    conditions.sun_azimuth += change * kMaxAzimuthChange * distinct_change(lot);
    conditions.sun_elevation += change * kMaxElevationChange * distinct_change(lot);
    conditions.exposure *= std::exp2(change * distinct_change(lot));
    Lot of_season(seeded_generator(seed, RandomPurpose::season, static_cast<std::uint64_t>(lap))());
    conditions.season = options.season_change * of_season.real(0.7, 1);
    return conditions;
}

cv::Mat with_image_effects(const cv::Mat& image,
                           const TConditionsOptions& options,
                           std::uint64_t seed,
                           std::uint64_t index)
{
    if (image.type() != CV_8UC3)
        throw std::invalid_argument("with_image_effects: the image is not 8 bit BGR");
    cv::Mat changed;
    if (options.blur_px > 0)
        cv::GaussianBlur(image, changed, cv::Size(), options.blur_px);
    else
        changed = image.clone();
    if (options.image_noise > 0)
        add_noise(changed,
                  PixelNoise(options.image_noise,
                             seeded_generator(seed, RandomPurpose::image_noise, index)));
    return changed;
}

}  // namespace fild
