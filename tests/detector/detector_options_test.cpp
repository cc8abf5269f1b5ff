// SPDX-License-Identifier: BSD-3-Clause
#include "fild/detector/detector_options.h"

#include "message_of.h"

#include <mrpt/config/CConfigFileMemory.h>

#include <cmath>
#include <limits>

namespace
{
using fild::testing::message_of;
using ::testing::HasSubstr;

TEST(DetectorOptions, DefaultsOfEverySectionAreValid)
{
    fild::TDetectorOptions options;
    EXPECT_EQ(options.sections().size(), 11U);
    for (const auto& [name, section] : options.sections())
        EXPECT_NO_THROW(section->check()) << name;
}

TEST(DetectorOptions, SurviveARoundTripThroughText)
{
    fild::TDetectorOptions options;
    options.index.delay_seconds = 12.5;
    options.verification.method = fild::RansacMethod::magsac;
    mrpt::config::CConfigFileMemory saved;
    for (const auto& [name, section] : options.sections()) section->saveToConfigFile(saved, name);
    fild::TDetectorOptions again;
    const mrpt::config::CConfigFileMemory parsed(saved.getContent());
    for (const auto& [name, section] : again.sections()) section->loadFromConfigFile(parsed, name);
    const auto before = options.sections();
    const auto after = again.sections();
    for (std::size_t i = 0; i < before.size(); ++i)
        EXPECT_EQ(before[i].second->values(), after[i].second->values()) << before[i].first;
}

TEST(ConsistencyOptions, BoundBeta)
{
    fild::TConsistencyOptions options;
    options.consecutive_frames = 0;
    EXPECT_THAT(message_of<std::invalid_argument>([&] { options.check(); }),
                HasSubstr("consecutive_frames=0 outside"));
}

TEST(ConsistencyOptions, TakeALookAheadOnlyWithTheBelief)
{
    fild::TConsistencyOptions options;
    const auto message = [&]
    { return message_of<std::invalid_argument>([&] { options.check(); }); };
    options.look_ahead_seconds = 3;
    EXPECT_THAT(message(), HasSubstr("look_ahead_seconds > 0 needs belief = true"));
    options.belief = true;
    EXPECT_NO_THROW(options.check());
    for (const double seconds :
         {-0.5, 4000.0, std::numeric_limits<double>::infinity(), std::nan("")})
    {
        options.look_ahead_seconds = seconds;
        EXPECT_THAT(message(), HasSubstr("look_ahead_seconds=")) << seconds;
    }
}

TEST(RuntimeOptions, RefuseANegativeSeed)
{
    fild::TRuntimeOptions options;
    options.seed = -1;
    EXPECT_THAT(message_of<std::invalid_argument>([&] { options.check(); }), HasSubstr("seed=-1"));
}

}  // namespace
