// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/verdict.h"
#include "fild/results/loops_csv.h"
#include "fild/results/run_summary.h"
#include "temporary_folder.h"

#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace fild::testing
{
/** A frame of a run at 10 Hz. */
inline FrameVerdict frame_at(std::size_t id)
{
    FrameVerdict verdict;
    verdict.frame = FrameId{id};
    verdict.timestamp = 1000 + 0.1 * static_cast<double>(id);
    verdict.sensor_label = "CAMERA1";
    verdict.keypoints = 500;
    verdict.rejection = Rejection::too_early;
    return verdict;
}

inline FrameVerdict loop_at(std::size_t id, std::size_t candidate)
{
    auto verdict = frame_at(id);
    verdict.candidate = Candidate{FrameId{candidate}, 0.8};
    verdict.matches = 60;
    verdict.inliers = 40;
    verdict.support = 2;
    verdict.rejection = Rejection::none;
    return verdict;
}

inline FrameVerdict rejected_at(std::size_t id, std::size_t candidate, double support)
{
    auto verdict = loop_at(id, candidate);
    verdict.support = support;
    verdict.rejection = Rejection::too_few_inliers;
    return verdict;
}

/** The folder of a run, written as rawlog-loop-closure writes it. */
class RunFolderFiles
{
 public:
    explicit RunFolderFiles(const std::vector<FrameVerdict>& frames,
                            const std::vector<LoopRow>& loops = {})
    {
        summary_.rawlog = "town.rawlog";
        summary_.options = {{"runtime", {{"seed", "1"}}}};
        summary_.versions = {{"mrpt-fild", "0.1.0"}};
        CsvWriter<FrameRow> csv(path("frames.csv"), frames_csv_columns());
        CsvWriter<LoopRow> loop_csv(path("loops.csv"), loops_csv_columns());
        std::size_t loop = 0;
        for (const auto& frame : frames)
        {
            csv.add({frame, "none"});
            summary_.add(frame);
            if (!frame.accepted()) continue;
            auto row = loop < loops.size() ? loops[loop] : LoopRow();
            row.verdict = frame;
            loop_csv.add(row);
            ++loop;
        }
        csv.commit();
        loop_csv.commit();
        write();
    }

    std::string path() const { return std::filesystem::path(path("")).parent_path().string(); }
    std::string path(const std::string& name) const { return folder_.path(name); }
    RunSummary& summary() { return summary_; }
    void write() const { write_summary(summary_, path("summary.json")); }

    /** A picture 1000 pixels wide. \param variant  "_3d" for the other view of the pair. */
    void add_match_picture(const FrameVerdict& pair, const std::string& variant = "") const
    {
        std::filesystem::create_directories(path("matches"));
        cv::imwrite(path("matches/" + std::to_string(to_index(pair.frame)) + "_" +
                         std::to_string(to_index(pair.candidate->frame)) + variant + ".jpg"),
                    cv::Mat(300, 1000, CV_8UC3, cv::Scalar(40, 90, 160)));
    }

 private:
    TemporaryFolder folder_;
    RunSummary summary_;
};

/** What a page holds for its script. */
inline nlohmann::json data_of_page(const std::string& path)
{
    const auto page = read_text(path);
    const std::string begin = "<script id=\"data\" type=\"application/json\">";
    const auto first = page.find(begin) + begin.size();
    return nlohmann::json::parse(page.substr(first, page.find("</script>", first) - first));
}

}  // namespace fild::testing
