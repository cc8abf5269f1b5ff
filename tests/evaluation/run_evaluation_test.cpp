// SPDX-License-Identifier: BSD-3-Clause
#include "fild/evaluation/run_evaluation.h"

#include "drawn_truth.h"
#include "message_of.h"

namespace
{
using fild::testing::frames_at_one_hertz;
using fild::testing::message_of;
using ::testing::HasSubstr;

fild::RunResults run_of(const std::string& folder, std::size_t frames)
{
    fild::RunResults run;
    run.folder = folder;
    run.frames = frames_at_one_hertz(frames);
    return run;
}

TEST(RunsTogether, MustBeOfOneRecording)
{
    auto later = run_of("later", 3);
    later.frames[2].timestamp += 1;
    EXPECT_NO_THROW(fild::require_same_recording({run_of("a", 3), run_of("b", 3)}));
    EXPECT_THAT(message_of<std::runtime_error>(
                    [] {
                        fild::require_same_recording({run_of("a", 3), run_of("b", 4)});
                    }),
                HasSubstr("b has another number of frames (4, not 3) than a"));
    EXPECT_THAT(message_of<std::runtime_error>(
                    [&] {
                        fild::require_same_recording({run_of("a", 3), later});
                    }),
                HasSubstr("later has another time of frame 2"));
}

TEST(EvaluateLoops, LooksAtCandidatesWhenThereAreAny)
{
    auto run = run_of("run", 5);
    const fild::LabelTruth truth(fild::to_loop_labels({{3, 0}, {4, 1}}, 5), 0);
    EXPECT_FALSE(fild::evaluate_loops(run, truth).candidates);
    run.answers.emplace(5);
    run.answers->at(3) = {{{fild::FrameId{2}, 0.9}, 1, false, 0, 0, 0, fild::Rejection::none},
                          {{fild::FrameId{0}, 0.8}, 2, false, 0, 0, 0, fild::Rejection::none}};
    const auto candidates = fild::evaluate_loops(run, truth).candidates;
    ASSERT_TRUE(candidates);
    EXPECT_EQ(candidates->recall[0], 0);
    EXPECT_EQ(candidates->recall[1], 0.5);
    ASSERT_EQ(candidates->lost.size(), 2U);
    EXPECT_EQ(candidates->lost[0].stage, fild::LossStage::retrieval);
}

TEST(EvaluateTrajectories, NamesTheOneThatDoesNotFit)
{
    auto run = run_of("run", 5);
    run.trajectories = {{"input", {{77, {}}}}};
    fild::TruePoses truth;
    truth.frames.resize(5);
    EXPECT_THAT(
        message_of<std::runtime_error>([&] { fild::evaluate_trajectories(run, truth, {}); }),
        HasSubstr("trajectory input of run: 0 poses"));
}

}  // namespace
