// SPDX-License-Identifier: BSD-3-Clause
// Every shipped configuration loads, names every key, and says what it claims to say.
#include "fild/core/ini_file.h"
#include "fild/graph/graph_options.h"
#include "fild/render/render_options.h"
#include "fild/report/report_options.h"
#include "fild/stream/loop_closure_stream.h"

#include <gtest/gtest.h>
#include <mrpt/config/CConfigFile.h>

#include <algorithm>
#include <filesystem>

namespace
{
const std::string kFolder = FILD_SOURCE_DIR "/config-ini/";
/** Of MRPT's graph-SLAM engine, which reads it; the deciders' keys name one of the others. */
const std::string kEngineFile = "graphslam_engine.ini";

struct AllOptions
{
    fild::TLoopClosureStreamOptions stream;
    fild::TGraphOptions graph;
    fild::TRenderOptions render;
    fild::TReportOptions report;

    std::vector<std::pair<std::string, fild::Options*>> sections()
    {
        auto all = stream.sections();
        all.emplace_back("graph", &graph);
        all.emplace_back("render", &render);
        all.emplace_back("report", &report);
        return all;
    }
};

AllOptions load(const std::string& name)
{
    AllOptions options;
    fild::load_sections(fild::load_ini_file(kFolder + name), options.sections());
    return options;
}

TEST(ConfigIni, EveryFileLoadsAndNamesEveryKey)
{
    int files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(kFolder))
    {
        const auto name = entry.path().filename().string();
        if (name == kEngineFile) continue;
        auto options = load(name);
        const auto ini = fild::load_ini_file(entry.path().string());
        for (const auto& [section, values] : options.sections())
        {
            std::vector<std::string> keys;
            ini.getAllKeys(section, keys);
            for (const auto& [key, value] : values->values())
                EXPECT_EQ(std::count(keys.begin(), keys.end(), key), 1)
                    << name << " lacks [" << section << "] " << key;
        }
        ++files;
    }
    EXPECT_EQ(files, 6);
}

TEST(ConfigIni, TheEnginesNamesConfigurationsThatLoad)
{
    ASSERT_TRUE(std::filesystem::exists(kFolder + kEngineFile));
    const mrpt::config::CConfigFile engine(kFolder + kEngineFile);
    for (const std::string section :
         {"NodeRegistrationDeciderParameters", "EdgeRegistrationDeciderParameters"})
    {
        const auto name = engine.read_string(section, "fild_config", "");
        EXPECT_NO_THROW(load(name)) << section;
    }
}

// FILD (An et al., IROS 2019), "Parameter List".
TEST(ConfigIni, PaperHasThePapersParameters)
{
    const auto options = load("fild_paper.ini").stream.detector;
    EXPECT_EQ(options.index.search_width, 40);
    EXPECT_EQ(options.index.construction_width, 40);
    EXPECT_EQ(options.index.links_per_node, 48);
    EXPECT_EQ(options.index.delay_seconds, 40);
    EXPECT_EQ(options.hashing.bits, 256);
    EXPECT_EQ(options.hashing.search, fild::CodeSearch::cascade);
    EXPECT_EQ(options.hashing.ratio, 0.7);
    EXPECT_FALSE(options.hashing.mutual_check);
    EXPECT_EQ(options.verification.min_inliers, 20);
    EXPECT_FALSE(options.verification.one_shape);
    EXPECT_FALSE(options.same_place.enabled);
    EXPECT_FALSE(options.consistency.belief);
    EXPECT_EQ(options.consistency.consecutive_frames, 2);
    EXPECT_EQ(options.index.candidates, 1);
    EXPECT_EQ(options.index.whiten_from, 0);
    EXPECT_EQ(options.local_features.min_keypoints, 0);
    EXPECT_EQ(options.candidates.neighbour_reach, 0);
    EXPECT_FALSE(options.candidates.follow_belief);
    EXPECT_EQ(options.global_descriptor.pooling, fild::Pooling::average);
}

}  // namespace
