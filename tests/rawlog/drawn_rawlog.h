// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "temporary_folder.h"

#include <mrpt/io/CFileGZOutputStream.h>
#include <mrpt/io/CFileOutputStream.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/serialization/CArchive.h>
#include <opencv2/core/mat.hpp>
#include <opencv2/imgproc.hpp>

#include <string>
#include <vector>

namespace fild::testing
{
/** An image with a white disc whose place depends on `seed`, on a dark ground. */
inline cv::Mat draw_image(int type = CV_8UC1, int seed = 0, cv::Size size = {64, 48})
{
    cv::Mat image(size, type, cv::Scalar(40, 30, 20, 200));
    cv::circle(image, {10 + seed % 40, 20}, 7, cv::Scalar(200, 250, 100, 90), cv::FILLED);
    return image;
}

inline mrpt::obs::CObservationImage::Ptr image_observation(const cv::Mat& image,
                                                           double seconds,
                                                           const std::string& label = "CAMERA1")
{
    auto observation = mrpt::obs::CObservationImage::Create();
    observation->image = mrpt::img::CImage(image, mrpt::img::DEEP_COPY);
    observation->timestamp = mrpt::Clock::fromDouble(seconds);
    observation->sensorLabel = label;
    return observation;
}

inline mrpt::obs::CObservationImage::Ptr external_observation(const std::string& file,
                                                              double seconds)
{
    auto observation = mrpt::obs::CObservationImage::Create();
    observation->image.setExternalStorage(file);
    observation->timestamp = mrpt::Clock::fromDouble(seconds);
    observation->sensorLabel = "CAMERA1";
    return observation;
}

using Objects = std::vector<mrpt::serialization::CSerializable::Ptr>;

/** Writes objects one after the other with MRPT's own streams. */
template <class Stream>
void write_objects(const std::string& path, const Objects& objects)
{
    Stream stream(path);
    auto archive = mrpt::serialization::archiveFrom(stream);
    for (const auto& object : objects) archive << *object;
}

inline void write_gz(const std::string& path, const Objects& objects)
{
    write_objects<mrpt::io::CFileGZOutputStream>(path, objects);
}

inline void write_plain(const std::string& path, const Objects& objects)
{
    write_objects<mrpt::io::CFileOutputStream>(path, objects);
}

}  // namespace fild::testing
