// SPDX-License-Identifier: BSD-3-Clause
#include "fild/graphslam/decider_options.h"

#include "message_of.h"
#include "temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace
{
using fild::load_decider_options;
using ::testing::HasSubstr;

class DeciderOptionsTest : public ::testing::Test
{
 protected:
    DeciderOptionsTest()
    {
        fild::testing::write_text(folder_.path("fild.ini"),
                                  "[graph]\ndrift_percent = 3\n[index]\ncandidates = 7\n"
                                  "[render]\nmax_match_pictures = 0\n");
    }

    std::string engine(const std::string& keys) const
    {
        auto path = folder_.path("engine.ini");
        fild::testing::write_text(path, "[Decider]\n" + keys);
        return path;
    }

    std::string error(const std::string& keys) const
    {
        const auto path = engine(keys);
        return fild::testing::message_of<std::exception>(
            [&] { load_decider_options(path, "Decider"); });
    }

    fild::testing::TemporaryFolder folder_;
};

TEST_F(DeciderOptionsTest, ComeFromTheConfigurationBesideTheEnginesFile)
{
    const auto options = load_decider_options(
        engine("fild_config = fild.ini\nLC_min_remote_nodes = 3\n"), "Decider");
    EXPECT_EQ(options.graph.drift_percent, 3);
    EXPECT_EQ(options.stream.detector.index.candidates, 7);
    EXPECT_EQ(options.verbosity, mrpt::system::LVL_INFO);
    const auto absolute = load_decider_options(
        engine("class_verbosity = 3\nfild_config = " + folder_.path("fild.ini") + "\n"), "Decider");
    EXPECT_EQ(absolute.graph.drift_percent, 3);
    EXPECT_EQ(absolute.verbosity, mrpt::system::LVL_ERROR);
}

TEST_F(DeciderOptionsTest, SayWhatIsWrong)
{
    EXPECT_THAT(error(""), HasSubstr("[Decider] fild_config is missing"));
    EXPECT_THAT(error("fild_config = other.ini\n"), HasSubstr("other.ini"));
    EXPECT_THAT(error("fild_config = fild.ini\nclass_verbosity = 4\n"),
                HasSubstr("class_verbosity=4 outside [0, 3]"));
    fild::testing::write_text(folder_.path("fild.ini"), "[graph]\ndrift = 3\n");
    EXPECT_THAT(error("fild_config = fild.ini\n"), HasSubstr("drift"));
    EXPECT_THAT(fild::testing::message_of<std::exception>(
                    [&] { load_decider_options(folder_.path("no.ini"), "Decider"); }),
                HasSubstr("no.ini: no such file"));
}

TEST_F(DeciderOptionsTest, OfTheShippedFileLoad)
{
    const std::string shipped = FILD_SOURCE_DIR "/config-ini/graphslam_engine.ini";
    for (const std::string section :
         {"NodeRegistrationDeciderParameters", "EdgeRegistrationDeciderParameters"})
        EXPECT_EQ(load_decider_options(shipped, section).verbosity, mrpt::system::LVL_ERROR);
}

}  // namespace
