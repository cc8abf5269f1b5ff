// SPDX-License-Identifier: BSD-3-Clause
#include "range_image.h"

#include "gz_archive.h"

#include <mrpt/obs/CObservation3DRangeScan.h>
#include <opencv2/core.hpp>

#include <filesystem>

namespace fild
{
namespace
{
using mrpt::math::CMatrix_u16;

/** As CObservation3DRangeScan::load(): rows, columns, then the numbers. */
CMatrix_u16 read_binary(const std::string& path)
{
    constexpr std::size_t kMostNumbers = std::size_t{1} << 26U;
    GzReader file(path);
    const auto rows = file.ReadAs<std::uint32_t>();
    const auto columns = file.ReadAs<std::uint32_t>();
    if (std::size_t{rows} * columns > kMostNumbers) return {};
    CMatrix_u16 ranges(rows, columns);
    if (ranges.size() > 0)
        file.ReadBufferFixEndianness<std::uint16_t>(ranges.data(),
                                                    static_cast<std::size_t>(ranges.size()));
    return ranges;
}

CMatrix_u16 read_external(const std::string& path)
{
    try
    {
        if (std::filesystem::path(path).extension() != ".txt") return read_binary(path);
        CMatrix_u16 ranges;
        ranges.loadFromTextFile(path);
        return ranges;
    }
    catch (const std::exception&)  // absent, cut off, no numbers: no ranges, as documented
    {
        return {};
    }
}

cv::Mat to_metres(const CMatrix_u16& ranges, double units)
{
    if (ranges.size() == 0) return {};
    const cv::Mat numbers(static_cast<int>(ranges.rows()),
                          static_cast<int>(ranges.cols()),
                          CV_16UC1,
                          const_cast<std::uint16_t*>(ranges.data()));  // cv::Mat has no const view
    cv::Mat metres;
    numbers.convertTo(metres, CV_32F, units);
    return metres;
}
}  // namespace

cv::Mat ranges_of(const mrpt::obs::CObservation3DRangeScan& scan, const std::string& external_path)
{
    const auto units = static_cast<double>(scan.rangeUnits);
    if (!scan.hasRangeImage || !(units > 0)) return {};
    return scan.rangeImage_isExternallyStored() ? to_metres(read_external(external_path), units)
                                                : to_metres(scan.rangeImage, units);
}

}  // namespace fild
