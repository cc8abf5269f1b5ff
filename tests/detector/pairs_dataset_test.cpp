// SPDX-License-Identifier: BSD-3-Clause
// The paper's own two loop pairs, and across them, under ten seeds.
#include "fild/core/ini_file.h"
#include "fild/detector/frame_describer.h"
#include "fild/detector/loop_detector.h"
#include "fild/features/model_file.h"

#include <gtest/gtest.h>
#include <mrpt/config/CConfigFileMemory.h>
#include <opencv2/imgcodecs.hpp>

#include <filesystem>
#include <map>

namespace
{
const std::string kPairs = FILD_TEST_DATA_DIR "/pairs/";
const std::vector<std::string> kNames = {
    "malaga6l_a.jpg", "malaga6l_b.jpg", "newcollege_a.png", "newcollege_b.png"};

bool same_place(std::size_t a, std::size_t b)
{
    return a / 2 == b / 2;
}

/** The detector's sections of a shipped .ini file. */
fild::TDetectorOptions options_of(const std::string& config, int seed)
{
    fild::TDetectorOptions options;
    const auto ini = fild::load_ini_file(FILD_SOURCE_DIR "/config-ini/" + config);
    for (const auto& [name, section] : options.sections()) section->loadFromConfigFile(ini, name);
    options.runtime.seed = seed;
    return options;
}

/** Features of all images; they do not depend on the seed, and are computed once for all tests that
 *  use one configuration. */
const std::vector<fild::FrameFeatures>& features_of_all(const std::string& config)
{
    static std::map<std::string, std::vector<fild::FrameFeatures>> known;
    auto& features = known[config];
    if (!features.empty()) return features;
    fild::FrameFeatureExtractor extractor(options_of(config, 1));
    fild::StageTimes times;
    for (const auto& name : kNames)
    {
        fild::Frame frame;
        frame.image = cv::imread(kPairs + name, cv::IMREAD_ANYCOLOR);
        features.push_back(extractor.extract(frame, times));
    }
    return features;
}

/** The verdict on `query` when `earlier` is all that was seen before. */
fild::FrameVerdict verdict_on(fild::FrameDescription query,
                              const fild::FrameDescription& earlier,
                              fild::TDetectorOptions options)
{
    options.index.delay_seconds =
        2;  // a longer gap between two frames might be a clock that was set
    fild::PlaceMap places;
    fild::LoopDetector detector(options, query.global.size(), places);
    fild::StageTimes times;
    detector.process(earlier, times);
    query.frame = fild::FrameId{1};
    query.timestamp = 2 * options.index.delay_seconds;
    return detector.process(std::move(query), times).front().verdict;
}

class Pairs : public ::testing::TestWithParam<int>
{
 protected:
    void SetUp() override
    {
        for (const auto& path :
             {kPairs + kNames[0], fild::find_model_file("mobilenet_v2_objectron.onnx")})
            if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is missing";
    }

    /** Expects every true pair to end with `of_true_pairs` and no other to be verified. */
    void expect_rejections(const std::string& config, fild::Rejection of_true_pairs) const
    {
        const auto options = options_of(config, GetParam());
        const fild::FrameHasher hasher(options);
        std::vector<fild::FrameDescription> all;
        for (const auto& features : features_of_all(config)) all.push_back(hasher.hash(features));
        for (std::size_t a = 0; a < all.size(); ++a)
            for (std::size_t b = 0; b < all.size(); ++b)
            {
                if (a == b) continue;
                const auto verdict = verdict_on(all[a], all[b], options);
                if (same_place(a, b))
                    EXPECT_EQ(to_word(verdict.rejection), to_word(of_true_pairs))
                        << kNames[a] << " and " << kNames[b];
                else
                    EXPECT_TRUE(verdict.rejection == fild::Rejection::too_few_matches ||
                                verdict.rejection == fild::Rejection::too_few_inliers ||
                                verdict.rejection == fild::Rejection::may_be_chance ||
                                verdict.rejection == fild::Rejection::no_model)
                        << kNames[a] << " and " << kNames[b] << ": " << to_word(verdict.rejection);
            }
    }
};

TEST_P(Pairs, AreAcceptedAndCrossPairsRejected)
{
    expect_rejections("default.ini", fild::Rejection::none);
}

// The paper wants two verified frames in a row, and a pair has but one.
TEST_P(Pairs, AreVerifiedWithThePapersSettings)
{
    expect_rejections("fild_paper.ini", fild::Rejection::not_consistent_yet);
}

INSTANTIATE_TEST_SUITE_P(TenSeeds, Pairs, ::testing::Range(1, 11));

}  // namespace
