// SPDX-License-Identifier: BSD-3-Clause
#include "fild/rawlog/calibration_file.h"

#include "message_of.h"
#include "temporary_folder.h"

#include <opencv2/core.hpp>

#include <cmath>

namespace
{
using namespace fild::testing;
using ::testing::HasSubstr;

fild::Calibration read(const std::string& text)
{
    const TemporaryFolder folder;
    write_text(folder.path("calib.txt"), text);
    return fild::read_calibration_file(folder.path("calib.txt"));
}

std::string error_of(const std::string& text)
{
    return message_of<std::runtime_error>([&] { read(text); });
}

TEST(CalibrationFile, ReadsOneCamera)
{
    const auto calibration = read("# left\n500 500 320 240 640 480 -0.3 0.1 0 0\n\n");
    EXPECT_DOUBLE_EQ(calibration.camera.distortion[0], -0.3);
    EXPECT_FALSE(calibration.baseline_m);
}

TEST(CalibrationFile, ReadsTheBaselineOfAPair)
{
    const auto calibration = read("500 501 320 240 640 480\n# metres\nbaseline\t 0.119\n");
    EXPECT_DOUBLE_EQ(calibration.camera.fy, 501);
    EXPECT_EQ(calibration.baseline_m, 0.119);
}

TEST(CalibrationFile, ReadsTwoCamerasThatDiffer)
{
    const auto calibration = read(
        "500 501 320 240 640 480 -0.3 0.1 0 0\n"
        "right 600 601 330 250 800 600\n"
        "right_pose 0.5 0.01 -0.02 0 0.0871557427 0 0.9961946981\n");
    EXPECT_DOUBLE_EQ(calibration.right_camera().fx, 600);
    EXPECT_EQ(calibration.right_camera().width, 800);
    const auto pose = calibration.left_from_right();
    ASSERT_TRUE(pose);
    EXPECT_EQ(pose->translation, cv::Vec3d(0.5, 0.01, -0.02));
    const auto axis = pose->rotation * cv::Vec3d(0, 0, 1);
    EXPECT_NEAR(axis[0], std::sin(10 * CV_PI / 180), 1e-6) << "turned by 10 degrees about y";
    EXPECT_NEAR(axis[2], std::cos(10 * CV_PI / 180), 1e-6);
}

TEST(CalibrationFile, SaysWhatIsWrongWithTheRightCamera)
{
    const std::string camera = "500 500 320 240 640 480\n";
    EXPECT_THAT(error_of(camera + "right 1 2 3"), HasSubstr("line 2: expected"));
    for (const std::string pose :
         {"", "0.5 0 0", "0.5 0 0 0 0 0 0", "0.5 0 0 0 0 0 2", "0.5 0 0 0 0 0 1 0"})
        EXPECT_THAT(error_of(camera + "right_pose " + pose),
                    HasSubstr("of the form 'right_pose X Y Z QX QY QZ QW'"))
            << pose;
    EXPECT_THAT(error_of(camera + "right_pose -0.5 0 0 0 0 0 1"), HasSubstr("to the right of"));
    EXPECT_THAT(error_of(camera + "baseline 1\nright_pose 0.5 0 0 0 0 0 1"), HasSubstr("line 3"));
}

TEST(CalibrationFile, NamesTheLineThatIsWrong)
{
    const std::string camera = "500 500 320 240 640 480\n";
    EXPECT_THAT(error_of(""), HasSubstr("no calibration in"));
    EXPECT_THAT(error_of("1 2 3\n"), HasSubstr("calib.txt line 1: expected"));
    EXPECT_THAT(error_of("baseline 0.1\n"), HasSubstr("calib.txt line 1: 'baseline'"));
    EXPECT_THAT(error_of(camera + camera),
                HasSubstr("line 2: '500 500 320 240 640 480' is neither"));
    for (const std::string line : {"baseline",
                                   "baseline 0",
                                   "baseline -0.1",
                                   "baseline nan",
                                   "baseline 0.1 m",
                                   "baseline 0.1 0.2"})
        EXPECT_THAT(error_of(camera + line), HasSubstr("of the form 'baseline METRES'"));
    EXPECT_THAT(error_of(camera + "baseline 0.1\nbaseline 0.2\n"), HasSubstr("line 3"));
}

}  // namespace
