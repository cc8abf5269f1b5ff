// SPDX-License-Identifier: BSD-3-Clause
#include "fild/run/judged_run.h"

#include "fild/evaluation/run_evaluation.h"
#include "fild/results/run_summary.h"

#include <vector>

namespace fild
{
namespace
{
/** The protocols that scores are usually given by, for labels and for poses. */
constexpr const char* kLabelProtocols[] = {"exact", "window:10"};
constexpr const char* kPoseProtocol = "radius:5";

ProtocolScore score_by(const Protocol& protocol, const RunResults& run, const LoopTruth& truth)
{
    return {protocol, score_loops(judge_frames(run.frames, truth))};
}

/** The usual protocols that the truth allows, without the one of `options`. */
std::vector<ProtocolScore> scores_by_others(const RunResults& run,
                                            const TruthOptions& options,
                                            const std::optional<TruePoses>& poses)
{
    std::vector<ProtocolScore> scores;
    const bool by_labels = options.protocol.kind != Protocol::Kind::radius;
    for (const auto* word : kLabelProtocols)
        if (by_labels && word != to_word(options.protocol))
        {
            auto other = options;
            other.protocol = parse_protocol(word);
            scores.push_back(score_by(other.protocol, run, *load_truth(other, run.frames).truth));
        }
    if (!poses || to_word(options.protocol) == kPoseProtocol) return scores;
    auto protocol = parse_protocol(kPoseProtocol);
    protocol.min_age_seconds = options.protocol.min_age_seconds;
    scores.push_back(score_by(protocol, run, *ground_truth_of(*poses, protocol).truth));
    return scores;
}
}  // namespace

ReportTruth judge_run(const std::string& folder,
                      const TruthOptions& options,
                      std::optional<double> delay_seconds)
{
    const auto run = read_run(folder);
    const auto of_run =
        for_run(options, delay_seconds ? delay_seconds : read_run_delay(folder + "/summary.json"));
    auto truth = load_truth(of_run, run.frames);
    ReportTruth judged;
    judged.description = {of_run.file, truth.content, truth.remarks, of_run.protocol};
    judged.evaluation = evaluate_loops(run, *truth.truth);
    const auto poses = true_poses_for(of_run, truth, run.frames);
    judged.other_protocols = scores_by_others(run, of_run, poses);
    if (!poses) return judged;
    judged.evaluation.trajectories = evaluate_trajectories(run, *poses, {});
    judged.poses = poses->frames;
    judged.oriented = poses->oriented;
    return judged;
}

}  // namespace fild
