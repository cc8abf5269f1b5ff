// SPDX-License-Identifier: BSD-3-Clause
#include "fild/results/csv_fields.h"
#include "frames_csv.h"
#include "run_command.h"
#include "temporary_folder.h"
#include "two_laps.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mrpt/io/CFileGZOutputStream.h>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include <algorithm>
#include <csignal>
#include <fcntl.h>
#include <filesystem>
#include <map>
#include <set>
#include <sys/file.h>
#include <unistd.h>

namespace
{
using fild::testing::Finished;
using fild::testing::kFramesPerLap;
using fild::testing::lines_of;
using fild::testing::Objects;
using fild::testing::read_text;
using fild::testing::two_laps;
using fild::testing::write_text;
using ::testing::AllOf;
using ::testing::Each;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;
namespace fs = std::filesystem;

class RawlogLoopClosure : public ::testing::Test
{
 protected:
    RawlogLoopClosure() { write_text(path("run.ini"), fild::testing::kTwoLapsConfig); }

    std::string path(const std::string& name) const { return folder_.path(name); }

    void write_rawlog(const Objects& objects) const
    {
        fild::testing::write_gz(path("run.rawlog"), objects);
    }

    /** A run over it takes a while. */
    void write_long_rawlog() const
    {
        Objects objects;
        const auto images = fild::testing::draw_two_laps(kFramesPerLap);
        for (int i = 0; i < 600; ++i)
            objects.push_back(fild::testing::image_observation(images[0], i));
        write_rawlog(objects);
    }

    /** A file of a run, and the beginning of a row of it. */
    struct Row
    {
        std::string file;
        std::string begin;
    };

    /** Starts a run in the background and sends it a signal when some frames have verdicts.
     *  \param before  a shell command to run first. \param awaited  the row to wait for. */
    Finished run_and_send(const std::string& signal,
                          const std::string& more,
                          const std::string& before = "",
                          const Row& awaited = {"frames.csv", "2,"}) const
    {
        fs::remove(path("out/" + awaited.file));
        const auto rows = "'" + path("out") + "'/" + awaited.file;
        return fild::testing::run_command(before + app() + arguments(more) +
                                          " & n=0; until grep -qs '^" + awaited.begin + "' " +
                                          rows + ".fild-part-* || [ -e " + rows +
                                          " ] || [ $n -ge 600 ]; do sleep 0.1; n=$((n+1)); done; "
                                          "kill -" +
                                          signal + " $!; wait $!");
    }

    static std::string app() { return "'" RAWLOG_LOOP_CLOSURE "' "; }

    std::string arguments(const std::string& more = "", const std::string& output = "out") const
    {
        return "--rawlog '" + path("run.rawlog") + "' --config '" + path("run.ini") +
               "' --output '" + path(output) + "' " + more;
    }

    Finished run(const std::string& more = "") const
    {
        return fild::testing::run_command(app() + arguments(more));
    }

    /** Expects a failure with one line on stderr; returns the line. */
    std::string error(const std::string& more = "", int exit_code = 1) const
    {
        const auto finished = run("--quiet " + more);
        EXPECT_EQ(finished.exit_code, exit_code) << finished.err;
        EXPECT_THAT(finished.err, StartsWith("rawlog-loop-closure: "));
        EXPECT_EQ(lines_of(finished.err).size(), 1U) << finished.err;
        return finished.err;
    }

    std::string frames_csv() const { return read_text(path("out/frames.csv")); }

    std::vector<fild::testing::FrameRow> rows() const
    {
        return fild::testing::read_frames_csv(path("out/frames.csv"));
    }

    nlohmann::json summary() const
    {
        return nlohmann::json::parse(read_text(path("out/summary.json")));
    }

    std::vector<std::string> output_names() const
    {
        std::vector<std::string> names;
        if (!fs::exists(path("out"))) return names;
        for (const auto& entry : fs::directory_iterator(path("out")))
            names.push_back(entry.path().filename().string());
        std::sort(names.begin(), names.end());
        return names;
    }

 private:
    fild::testing::TemporaryFolder folder_;
};

const std::vector<std::string> kAllOutputs = {"candidates.csv",
                                              "costs.csv",
                                              "frames.csv",
                                              "loops.csv",
                                              "matches",
                                              "report.html",
                                              "similarity.png",
                                              "summary.json"};

TEST_F(RawlogLoopClosure, ShowsHelpAndVersion)
{
    const auto help = fild::testing::run_command(app() + "--help");
    EXPECT_EQ(help.exit_code, 0);
    for (const auto* flag :
         {"--rawlog", "--config", "--output", "--set", "--max-frames", "--quiet"})
        EXPECT_THAT(help.out, HasSubstr(flag));
    const auto version = fild::testing::run_command(app() + "--version");
    EXPECT_EQ(version.exit_code, 0);
    EXPECT_THAT(version.out, HasSubstr("0.1.0"));
}

TEST_F(RawlogLoopClosure, SaysOnATerminalWhatItDoes)
{
    write_rawlog(two_laps());
    const auto on_terminal = [this](const std::string& more)
    {
        return fild::testing::run_command("script -qec \"" + app() + arguments(more) +
                                          "\" /dev/null")
            .out;
    };
    EXPECT_THAT(on_terminal(""),
                AllOf(StartsWith("reading the network ..."),
                      HasSubstr("making the map and the pictures ...")));
    EXPECT_THAT(on_terminal("--quiet"), Not(HasSubstr("...")));
}

TEST_F(RawlogLoopClosure, ExitsWithTwoOnWrongUsage)
{
    for (const std::string line : {"", "--rawlog x", "--no-such-flag"})
    {
        const auto finished = fild::testing::run_command(app() + line);
        EXPECT_EQ(finished.exit_code, 2) << line;
        EXPECT_THAT(finished.err, HasSubstr("see --help")) << line;
        EXPECT_EQ(lines_of(finished.err).size(), 1U) << finished.err;
    }
    EXPECT_THAT(fild::testing::run_command(app() + "--rawlog x").err,
                AllOf(HasSubstr("missing: --output"),
                      Not(HasSubstr("--config")),
                      Not(HasSubstr("--rawlog"))));
    EXPECT_THAT(error("--max-frames 0", 2), HasSubstr("--max-frames"));
}

TEST_F(RawlogLoopClosure, FindsTheSecondLap)
{
    write_rawlog(two_laps());
    const auto finished = run();
    ASSERT_EQ(finished.exit_code, 0) << finished.err;
    EXPECT_THAT(finished.out, StartsWith("16 frames, 8 loop closures"));
    EXPECT_EQ(output_names(), kAllOutputs);

    const auto all = rows();
    ASSERT_EQ(all.size(), 2U * kFramesPerLap);
    for (std::size_t i = kFramesPerLap; i < all.size(); ++i)
    {
        EXPECT_EQ(all[i].frame, i);
        EXPECT_EQ(all[i].candidate, i - kFramesPerLap);
        EXPECT_TRUE(all[i].accepted);
        const auto name = std::to_string(i) + "_" + std::to_string(i - kFramesPerLap) + ".jpg";
        EXPECT_FALSE(cv::imread(path("out/matches/" + name)).empty()) << name;
    }
    EXPECT_EQ(lines_of(read_text(path("out/loops.csv"))).size(), 9U);
    EXPECT_EQ(summary()["frames"]["loop_closures"], 8);
    EXPECT_TRUE(summary()["complete"].get<bool>());
    EXPECT_EQ(summary()["model"]["sha256"].get<std::string>().size(), 64U);
    EXPECT_TRUE(summary()["stage_times_ms"].contains("verification"));
}

TEST_F(RawlogLoopClosure, GivesTheSameBytesAgainAndWithTwoThreads)
{
    write_rawlog(two_laps());
    ASSERT_EQ(run("--set runtime.num_threads=1").exit_code, 0);
    const auto frames = frames_csv();
    const auto loops = read_text(path("out/loops.csv"));
    const auto candidates = read_text(path("out/candidates.csv"));
    EXPECT_GT(lines_of(candidates).size(), 1U);
    for (const std::string threads : {"1", "2"})
    {
        ASSERT_EQ(run("--set runtime.num_threads=" + threads).exit_code, 0);
        EXPECT_EQ(frames_csv(), frames);
        EXPECT_EQ(read_text(path("out/loops.csv")), loops);
        EXPECT_EQ(read_text(path("out/candidates.csv")), candidates);
    }
    ASSERT_EQ(run("--set runtime.seed=2").exit_code, 0);
    EXPECT_NE(frames_csv(), frames);
}

/** Arguments for evidence that leaves some doubt in a pair alone, and a belief that looks ahead. */
std::string looking_ahead(const std::string& seconds)
{
    return "--set verification.one_shape=true --set same_place.enabled=true "
           "--set same_place.chance_inliers=2 --set same_place.look_alike_bias=2.5 "
           "--set consistency.belief=true --set consistency.look_ahead_seconds=" +
           seconds + " ";
}

TEST_F(RawlogLoopClosure, WithLookAheadHasOneVerdictForEveryFrameInOrder)
{
    write_rawlog(two_laps());
    ASSERT_EQ(run(looking_ahead("0")).exit_code, 0);
    const auto on_line = summary()["frames"]["loop_closures"].get<int>();
    const auto candidates = read_text(path("out/candidates.csv"));
    ASSERT_EQ(run(looking_ahead("3")).exit_code, 0);
    EXPECT_GT(summary()["frames"]["loop_closures"].get<int>(), on_line);
    EXPECT_EQ(read_text(path("out/candidates.csv")), candidates) << "of the pairs alone";
    for (const auto* file : {"out/frames.csv", "out/costs.csv"})
    {
        const auto rows = lines_of(read_text(path(file)));
        ASSERT_EQ(rows.size(), 1 + 2 * kFramesPerLap) << file;
        for (std::size_t i = 0; i < 2 * kFramesPerLap; ++i)
            EXPECT_THAT(rows[i + 1], StartsWith(std::to_string(i) + ",")) << file;
    }
    const auto frames = frames_csv();
    for (const auto* threads : {"1", "2"})
    {
        ASSERT_EQ(run(looking_ahead("3") + "--set runtime.num_threads=" + threads).exit_code, 0);
        EXPECT_EQ(frames_csv(), frames);
    }
    ASSERT_EQ(run(looking_ahead("3") + "--max-frames 12").exit_code, 0);
    EXPECT_EQ(lines_of(frames_csv()).size(), 13U);
}

TEST_F(RawlogLoopClosure, HonoursLimitsOfFramesAndPictures)
{
    write_rawlog(two_laps());
    ASSERT_EQ(run("--max-frames 12 --set render.max_match_pictures=2 "
                  "--set report.max_rejected_pictures=0")
                  .exit_code,
              0);
    EXPECT_EQ(lines_of(frames_csv()).size(), 13U);
    EXPECT_EQ(summary()["frames"]["match_pictures"], 2);
    EXPECT_EQ(std::distance(fs::directory_iterator(path("out/matches")), {}), 2);
    write_text(path("out/matches/notes.txt"), "mine");
    ASSERT_EQ(run("--set render.max_match_pictures=0").exit_code, 0);
    EXPECT_EQ(read_text(path("out/matches/notes.txt")), "mine");  // and our old pictures are gone
    EXPECT_EQ(std::distance(fs::directory_iterator(path("out/matches")), {}), 1);
}

TEST_F(RawlogLoopClosure, ReportsTheRun)
{
    write_rawlog(two_laps());
    ASSERT_EQ(run("--set 'input.sensor_label=CAMERA.*'").exit_code, 0);
    const auto page = read_text(path("out/report.html"));
    EXPECT_THAT(page, AllOf(HasSubstr("\"15_7\""), HasSubstr("data:image/jpeg")));
    EXPECT_THAT(summary()["command"].get<std::string>(),
                HasSubstr(" --set 'input.sensor_label=CAMERA.*'"));
    const auto matrix = cv::imread(path("out/similarity.png"), cv::IMREAD_GRAYSCALE);
    EXPECT_EQ(matrix.size(), cv::Size(16, 16));
    EXPECT_GT(matrix(cv::Rect(0, 8, 8, 8)).diag(0).at<uchar>(3), 200);  // frames 11 and 3
    EXPECT_EQ(lines_of(read_text(path("out/costs.csv"))).size(), 17U);

    ASSERT_EQ(run("--set report.write_html=false --set report.similarity_frames=0").exit_code, 0);
    EXPECT_FALSE(fs::exists(path("out/report.html"))) << "that of the run before is removed";
    EXPECT_FALSE(fs::exists(path("out/similarity.png")));
}

TEST_F(RawlogLoopClosure, ListsWrongAndMissedLoops)
{
    write_rawlog(two_laps());
    // Frame i shows what frame i - 8 shows; the labels say otherwise of 15, and that 3 came back.
    std::string labels = "3 0\n15 0\n";
    for (int i = 8; i < 15; ++i) labels += std::to_string(i) + " " + std::to_string(i - 8) + "\n";
    write_text(path("loops.txt"), labels);
    const auto finished =
        run("--ground-truth '" + path("loops.txt") + "' --set render.max_match_pictures=1");
    ASSERT_EQ(finished.exit_code, 0) << finished.out;
    EXPECT_THAT(read_text(path("out/wrong_loops.csv")),
                AllOf(HasSubstr("run,frame,candidate,"),
                      HasSubstr("\n1,15,7,"),
                      HasSubstr("matches/15_7.jpg\n")))
        << "its picture is drawn first";
    EXPECT_THAT(lines_of(read_text(path("out/missed_loops.csv"))),
                ::testing::Contains("1,3,too_early"));
    EXPECT_THAT(finished.out,
                AllOf(HasSubstr("against the ground truth (exact): "),
                      HasSubstr(path("out/wrong_loops.csv")),
                      HasSubstr(path("out/missed_loops.csv")),
                      HasSubstr("look at " + path("out") + "/report.html"),
                      HasSubstr("too_early: ")));
    ASSERT_EQ(run().exit_code, 0);
    EXPECT_FALSE(fs::exists(path("out/wrong_loops.csv"))) << "those of the run before are removed";
    EXPECT_FALSE(fs::exists(path("out/missed_loops.csv")));
}

TEST_F(RawlogLoopClosure, DrawsTheStrongestRejectedPairs)
{
    write_rawlog(two_laps());
    const std::string all_rejected =
        "--set same_place.enabled=true --set same_place.chance_bias=-8 --set "
        "same_place.chance_inliers=1 ";
    ASSERT_EQ(run(all_rejected + "--set report.max_rejected_pictures=3").exit_code, 0);
    EXPECT_EQ(summary()["frames"]["loop_closures"], 0);
    std::multimap<double, std::string> by_support;
    const auto all = lines_of(frames_csv());
    for (std::size_t i = 1; i < all.size(); ++i)
    {
        const auto row = fild::split_csv_fields(all[i]);
        by_support.emplace(-std::stod(row[10]), row[0] + "_" + row[4] + ".jpg");
    }
    std::set<std::string> strongest;
    for (auto pair = by_support.begin(); strongest.size() < 3; ++pair)
        strongest.insert(pair->second);
    std::set<std::string> drawn;
    for (const auto& entry : fs::directory_iterator(path("out/matches")))
        drawn.insert(entry.path().filename().string());
    EXPECT_EQ(drawn, strongest);
    ASSERT_EQ(run(all_rejected + "--set render.max_match_pictures=0").exit_code, 0);
    EXPECT_TRUE(fs::is_empty(path("out/matches")));
}

TEST_F(RawlogLoopClosure, NamesWhatIsWrongWithItsInputs)
{
    EXPECT_THAT(error(), HasSubstr("run.rawlog"));
    write_text(path("run.rawlog"), "this is a text, not a rawlog");
    EXPECT_THAT(error(), HasSubstr("run.rawlog"));
    write_rawlog(two_laps());
    EXPECT_THAT(error("--set index.serch_width=5", 2),
                HasSubstr("unknown key 'serch_width'; did you mean search_width? known keys: "));
    EXPECT_THAT(error("--set indx.search_width=5", 2),
                HasSubstr("unknown section [indx]; did you mean index? known sections: ["));
    EXPECT_THAT(error("--set search_width=5", 2), HasSubstr("section.key=value"));
    EXPECT_THAT(error("--set verification.min_inliers=lots", 2), HasSubstr("min_inliers='lots'"));
    EXPECT_THAT(error("--set global_descriptor.model_file=/no/such.onnx"),
                AllOf(HasSubstr("/no/such.onnx"), HasSubstr("get-model.sh")));
    EXPECT_THAT(error("--set global_descriptor.dimension=640"),
                AllOf(HasSubstr("descriptors of 8 numbers"), HasSubstr("dimension=640")));
    EXPECT_EQ(output_names(), std::vector<std::string>{});
}

TEST_F(RawlogLoopClosure, TakesTheDefaultConfigurationWhenNoneIsGiven)
{
    write_rawlog(two_laps());
    std::string of_the_tests_network = " --set global_descriptor.model_file=" FILD_TINY_NETWORK;
    for (const auto* value : {"global_descriptor.layers=map",
                              "global_descriptor.dimension=8",
                              "global_descriptor.input_width=4",
                              "global_descriptor.input_height=4",
                              "global_descriptor.cell_layer=",
                              "candidates.best_by_cells=0",
                              "hashing.search=exhaustive"})
        of_the_tests_network += std::string(" --set ") + value;
    std::vector<nlohmann::json> options;
    for (const std::string config : {"", " --config '" FILD_SOURCE_DIR "/config-ini/default.ini'"})
    {
        const auto finished = fild::testing::run_command(
            app() + "--quiet --rawlog '" + path("run.rawlog") + "' --output '" + path("out") + "'" +
            of_the_tests_network + config);
        ASSERT_EQ(finished.exit_code, 0) << finished.err;
        options.push_back(summary()["options"]);
    }
    EXPECT_EQ(options[0], options[1]);
    EXPECT_EQ(options[0]["hashing"]["rooted"], "true") << "off without a configuration";
}

TEST_F(RawlogLoopClosure, ListsTheLabelsWhenNoneMatches)
{
    write_rawlog(two_laps("FRONT_LEFT"));
    EXPECT_THAT(error("--set 'input.sensor_label=.*RIGHT'"),
                AllOf(HasSubstr(".*RIGHT"), HasSubstr("FRONT_LEFT")));
    EXPECT_EQ(output_names(), std::vector<std::string>{});
}

TEST_F(RawlogLoopClosure, KeepsTheResultsBeforeATruncation)
{
    write_rawlog(two_laps());
    fs::resize_file(path("run.rawlog"), fs::file_size(path("run.rawlog")) * 3 / 4);
    EXPECT_THAT(error(), AllOf(HasSubstr("run.rawlog"), HasSubstr("frames before are in")));
    EXPECT_EQ(output_names(), kAllOutputs);
    const auto rows = lines_of(frames_csv()).size();
    EXPECT_GT(rows, 5U);
    EXPECT_LT(rows, 17U);
    EXPECT_FALSE(summary()["complete"].get<bool>());
    EXPECT_THAT(summary()["ended_early"].get<std::string>(), HasSubstr("run.rawlog"));
}

TEST_F(RawlogLoopClosure, SkipsAMissingImageOrStops)
{
    auto objects = two_laps();
    objects.insert(objects.begin() + 3, fild::testing::external_observation("gone.png", 2.5));
    write_rawlog(objects);
    ASSERT_EQ(run().exit_code, 0);
    EXPECT_EQ(rows()[3].rejection, "missing_image");
    EXPECT_EQ(summary()["frames"]["rejections"]["missing_image"], 1);
    EXPECT_EQ(summary()["frames"]["loop_closures"], 8);
    EXPECT_THAT(error("--set input.on_missing_image=stop"), HasSubstr("gone.png"));
    EXPECT_EQ(lines_of(frames_csv()).size(), 4U);  // the header and three frames
}

TEST_F(RawlogLoopClosure, FailsWhenAllImagesAreMissing)
{
    Objects objects;
    for (int i = 0; i < 3; ++i)
        objects.push_back(fild::testing::external_observation("gone.png", i));
    write_rawlog(objects);
    const auto finished = run("--quiet");
    EXPECT_EQ(finished.exit_code, 1);
    EXPECT_THAT(finished.err, AllOf(HasSubstr("gone.png"), HasSubstr("images_dir")));
    EXPECT_EQ(rows().size(), 3U);
}

TEST_F(RawlogLoopClosure, WritesTheSummaryWhenPicturesCannotBeDrawn)
{
    write_rawlog(two_laps());
    fs::create_directory(path("out"));
    write_text(path("out/matches"), "a file where a folder should be");
    EXPECT_THAT(error(), HasSubstr("no more match pictures"));
    EXPECT_FALSE(summary()["complete"].get<bool>());
    EXPECT_EQ(rows().size(), 2U * kFramesPerLap);
}

TEST_F(RawlogLoopClosure, RemovesWhatAKilledRunLeft)
{
    write_rawlog(two_laps());
    fs::create_directory(path("out"));
    write_text(path("out/frames.csv.fild-part-1"), "half");
    ASSERT_EQ(run().exit_code, 0);
    EXPECT_EQ(output_names(), kAllOutputs);
}

TEST_F(RawlogLoopClosure, LeavesFilesOfOthersInItsFolder)
{
    write_rawlog(two_laps());
    fs::create_directories(path("out/matches"));
    const auto others = {"out/big.tar.part-01", "out/x.part-1234", "out/matches/1_0.jpg.part-7"};
    for (const auto* name : others) write_text(path(name), "mine");
    ASSERT_EQ(run().exit_code, 0);
    for (const auto* name : others) EXPECT_EQ(read_text(path(name)), "mine") << name;
}

TEST_F(RawlogLoopClosure, KeepsTheResultsOfAnEarlierRunUntilItHasItsOwn)
{
    write_rawlog(two_laps());
    ASSERT_EQ(run().exit_code, 0);
    const auto summary_before = read_text(path("out/summary.json"));
    EXPECT_THAT(error("--set 'input.sensor_label=.*RIGHT'"), HasSubstr("no camera observation"));
    EXPECT_EQ(output_names(), kAllOutputs);
    EXPECT_EQ(read_text(path("out/summary.json")), summary_before);
}

TEST_F(RawlogLoopClosure, LeavesItsVerdictsWhenItIsKilled)
{
    write_long_rawlog();
    EXPECT_EQ(run_and_send("KILL", "-q").exit_code, 128 + SIGKILL);
    std::size_t rows = 0;
    for (const auto& name : output_names())
        if (name.rfind("frames.csv.fild-part-", 0) == 0)
            rows = lines_of(read_text(path("out/" + name))).size();
    EXPECT_GT(rows, 2U);
    ASSERT_EQ(run("--max-frames 2").exit_code, 0);
    EXPECT_EQ(output_names(), kAllOutputs);
}

TEST_F(RawlogLoopClosure, OutlivesItsTerminalUnderNohup)
{
    write_long_rawlog();
    const auto finished = run_and_send("HUP", "-q --max-frames 30", "trap '' HUP; ");
    EXPECT_EQ(finished.exit_code, 0) << finished.err;
    const auto interrupted = run_and_send("HUP", "-q");
    EXPECT_THAT(interrupted.err, HasSubstr("interrupted")) << "without nohup";
}

TEST_F(RawlogLoopClosure, OutlivesTheReaderOfItsOutput)
{
    write_rawlog(two_laps());
    fild::testing::run_command("{ " + app() + arguments() + "; echo $? >'" + path("status") +
                               "'; } 2>&1 | true");
    EXPECT_EQ(read_text(path("status")), "0\n");
    EXPECT_TRUE(summary()["complete"].get<bool>());
}

TEST_F(RawlogLoopClosure, FailsWhenItsOutputCannotBeWritten)
{
    write_rawlog(two_laps());
    const auto finished = fild::testing::run_command(app() + arguments("--quiet") + " >/dev/full");
    EXPECT_EQ(finished.exit_code, 1);
    EXPECT_THAT(finished.err, HasSubstr("standard output"));
    EXPECT_FALSE(summary()["complete"].get<bool>());
    EXPECT_EQ(output_names(), kAllOutputs);
}

TEST_F(RawlogLoopClosure, IsNotCompleteWithoutItsReport)
{
    write_rawlog(two_laps());
    // A limit of 500 kB a file, which the charts alone exceed, stands in for a full disk.
    const auto finished =
        fild::testing::run_command("ulimit -f 1000; " + app() + arguments("--quiet"));
    EXPECT_EQ(finished.exit_code, 1);
    EXPECT_THAT(finished.err, HasSubstr("no report"));
    EXPECT_FALSE(fs::exists(path("out/report.html")));
    EXPECT_FALSE(summary()["complete"].get<bool>());
    EXPECT_THAT(summary()["ended_early"].get<std::string>(), HasSubstr("no report"));
}

TEST_F(RawlogLoopClosure, ReadsBackALabelWithALineBreak)
{
    write_rawlog(two_laps("LEFT\n\"front\", upper"));
    ASSERT_EQ(run().exit_code, 0);
    EXPECT_EQ(output_names(), kAllOutputs);
    EXPECT_THAT(read_text(path("out/report.html")), HasSubstr("LEFT\\n"));
}

TEST_F(RawlogLoopClosure, MatchesNoPatternWithAnEndlessLabel)
{
    write_rawlog(two_laps(std::string(100000, 'x')));
    const auto line = error("--set 'input.sensor_label=.*'");
    EXPECT_THAT(line, HasSubstr("camera labels there"));
    EXPECT_LT(line.size(), 8000U);
    const auto value = std::string(70000, '7') + "x";
    EXPECT_LT(error("--set index.delay_seconds=" + value, 2).size(), 500U);
    EXPECT_LT(error("--set 'input.sensor_label=" + value + "'", 2).size(), 500U);
}

// Camera B sees the images of A mirrored, a tenth of a second later than A: no place of A is one of
// B.
TEST_F(RawlogLoopClosure, LooksAtTwoCamerasWhenAskedTo)
{
    Objects objects;
    double seconds = 0;
    for (const auto& image : fild::testing::draw_two_laps(kFramesPerLap))
    {
        cv::Mat mirrored;
        cv::flip(image, mirrored, 1);
        objects.push_back(fild::testing::image_observation(image, seconds, "A"));
        objects.push_back(fild::testing::image_observation(mirrored, seconds + 0.1, "B"));
        seconds += 1;
    }
    write_rawlog(objects);
    ASSERT_EQ(run("--set 'input.sensor_label=A|B'").exit_code, 0);
    const auto all = rows();
    ASSERT_EQ(all.size(), 4U * kFramesPerLap);
    const auto lines = lines_of(frames_csv());
    for (const auto& row : all)
    {
        EXPECT_THAT(lines[row.frame + 1], HasSubstr(row.frame % 2 == 0 ? ",A," : ",B,"));
        EXPECT_EQ(row.accepted, row.frame >= 2 * kFramesPerLap) << row.frame;
        if (row.accepted)
        {
            EXPECT_EQ(row.candidate.value(), row.frame - 2 * kFramesPerLap);
        }
    }
    EXPECT_FALSE(summary()["frames"]["rejections"].contains("repeated_timestamp"));
}

TEST_F(RawlogLoopClosure, CountsWhatItCannotUse)
{
    using fild::testing::image_observation;
    const cv::Mat black = cv::Mat::zeros(240, 320, CV_8UC1);
    auto objects = two_laps();
    objects.insert(objects.begin() + 2, image_observation(black, 1.5));
    objects.insert(objects.begin() + 5, image_observation(cv::Mat::zeros(1, 1, CV_8UC1), 3.5));
    objects.insert(objects.begin() + 6, image_observation(black, 3.5));
    objects.insert(objects.begin() + 7, image_observation(black, 3.5));
    write_rawlog(objects);
    ASSERT_EQ(run().exit_code, 0);
    const auto all = rows();
    ASSERT_EQ(all.size(), 20U);
    EXPECT_EQ(all[2].rejection, "too_early");
    EXPECT_EQ(all[5].rejection, "image_size_changed");
    EXPECT_EQ(all[6].rejection, "too_early") << "another image";
    EXPECT_EQ(all[7].rejection, "repeated_timestamp");
    EXPECT_EQ(summary()["frames"]["loop_closures"], 8);
}

TEST_F(RawlogLoopClosure, FailsWhenItCanUseOneFrameOfMany)
{
    Objects objects;
    const auto image = fild::testing::draw_two_laps(1)[0];
    for (int i = 0; i < 5; ++i) objects.push_back(fild::testing::image_observation(image, 1));
    write_rawlog(objects);
    EXPECT_THAT(error(), HasSubstr("only one frame of 5 could be used (4 repeated_timestamp)"));
    objects.assign(1, objects[0]);
    write_rawlog(objects);
    EXPECT_EQ(run().exit_code, 0) << "a recording of one frame";
}

TEST_F(RawlogLoopClosure, SaysWhyNoFrameIsOldEnough)
{
    auto objects = two_laps();
    write_rawlog(objects);
    EXPECT_THAT(run("--quiet --set index.delay_seconds=60").err,
                AllOf(HasSubstr("span 15 s"), HasSubstr("[index] delay_seconds = 60")));
    EXPECT_THAT(
        run("--quiet --set index.delay_seconds=10 --set index.frame_rate=2").err,
        HasSubstr("there are not more frames than [index] delay_seconds x frame_rate = 20"));
    for (auto& object : objects)
        std::dynamic_pointer_cast<mrpt::obs::CObservation>(object)->timestamp =
            mrpt::Clock::fromDouble(1000);
    write_rawlog(objects);
    const auto all_the_same = run("--quiet");
    EXPECT_THAT(all_the_same.err, AllOf(HasSubstr("all the same"), HasSubstr("frame_rate")));
    EXPECT_EQ(summary()["frames"]["notes"].size(), 1U);
    EXPECT_THAT(run("--quiet --set index.frame_rate=1").out, HasSubstr("8 loop closures"));
}

TEST_F(RawlogLoopClosure, GoesOnWithoutACalibrationForAnotherSize)
{
    auto objects = two_laps();
    for (auto& object : objects)
    {
        auto& camera =
            std::dynamic_pointer_cast<mrpt::obs::CObservationImage>(object)->cameraParams;
        camera.setIntrinsicParamsFromValues(300, 300, 160, 120);
        camera.ncols = 640;
        camera.nrows = 480;
    }
    write_rawlog(objects);
    const auto finished = run("--quiet");
    EXPECT_EQ(finished.exit_code, 0);
    EXPECT_THAT(finished.out, HasSubstr("8 loop closures"));
    EXPECT_THAT(finished.err,
                HasSubstr("set [input] camera_parameters = 300 300 160 120 320 240\n"));
    EXPECT_THAT(run("--quiet --set 'input.camera_parameters=300 300 160 120 320 240'").err,
                Not(HasSubstr("calibration")));
}

TEST_F(RawlogLoopClosure, NamesThePixelsThatItCannotUse)
{
    Objects objects;
    for (int i = 0; i < 3; ++i)
        objects.push_back(fild::testing::image_observation(cv::Mat(48, 64, CV_32FC1, 0.5), i));
    write_rawlog(objects);
    EXPECT_THAT(error(),
                AllOf(HasSubstr("3 unsupported_image"), HasSubstr("32 bit floating point")));
}

TEST_F(RawlogLoopClosure, WritesLabelsThatAreNotUtf8)
{
    write_rawlog(two_laps("K\xE4mera"));
    ASSERT_EQ(run().exit_code, 0);
    EXPECT_THAT(frames_csv(), HasSubstr(",K\xC3\xA4mera,"));
    EXPECT_THAT(read_text(path("out/loops.csv")), HasSubstr(",K\xC3\xA4mera,"));
}

TEST_F(RawlogLoopClosure, FindsASecondLapWithImagesOfAnotherSizeInGrey)
{
    Objects objects;
    double seconds = 0;
    const auto images = fild::testing::draw_two_laps(kFramesPerLap);
    for (std::size_t i = 0; i < images.size(); ++i)
    {
        cv::Mat image = images[i];
        if (i >= kFramesPerLap)
            cv::resize(image, image, {}, 1.5, 1.5, cv::INTER_LINEAR);
        else
            cv::cvtColor(image, image, cv::COLOR_GRAY2BGR);
        objects.push_back(fild::testing::image_observation(image, seconds++));
    }
    write_rawlog(objects);
    const auto finished = run();
    ASSERT_EQ(finished.exit_code, 0) << finished.err;
    EXPECT_THAT(finished.err,
                HasSubstr("note: 8 images were scaled to the size of their camera's first image"));
    EXPECT_EQ(summary()["frames"]["scaled_frames"], 8);
    EXPECT_EQ(summary()["frames"]["loop_closures"], 8);
    EXPECT_FALSE(fs::is_empty(path("out/matches")));
}

TEST_F(RawlogLoopClosure, BearsImagesOfOnePixel)
{
    Objects objects;
    for (int i = 0; i < 12; ++i)
        objects.push_back(fild::testing::image_observation(cv::Mat::zeros(1, 1, CV_8UC3), i));
    write_rawlog(objects);
    ASSERT_EQ(run().exit_code, 0);
    EXPECT_EQ(rows().back().rejection, "too_few_matches");
}

TEST_F(RawlogLoopClosure, GoesOnWhenTheClockJumpsBack)
{
    Objects objects;
    double seconds = 1000;
    for (const auto& image : fild::testing::draw_two_laps(kFramesPerLap))
    {
        objects.push_back(fild::testing::image_observation(image, seconds++));
        if (objects.size() == 4) seconds = 10;
    }
    write_rawlog(objects);
    ASSERT_EQ(run().exit_code, 0);
    EXPECT_EQ(summary()["frames"]["clock_jumps"], 1);
    EXPECT_EQ(summary()["frames"]["loop_closures"], 8);
}

TEST_F(RawlogLoopClosure, LeavesNothingHalfWrittenWhenItCannotWrite)
{
    write_rawlog(two_laps());
    write_text(path("file"), "");
    const auto into_file = fild::testing::run_command(app() + arguments("-q", "file/out"));
    EXPECT_EQ(into_file.exit_code, 1);
    EXPECT_THAT(into_file.err, HasSubstr(path("file/out")));
    // A limit of 512 bytes a file stands in for a full disk.
    const auto full =
        fild::testing::run_command("ulimit -f 1; trap '' XFSZ; " + app() + arguments("-q"));
    EXPECT_EQ(full.exit_code, 1);
    EXPECT_THAT(full.err, HasSubstr("disk full"));
    EXPECT_THAT(output_names(), Each(Not(HasSubstr(".part"))));
    EXPECT_FALSE(fs::exists(path("out/frames.csv")));
}

TEST_F(RawlogLoopClosure, RefusesAFolderThatAnotherRunHolds)
{
    write_rawlog(two_laps());
    fs::create_directory(path("out"));
    const int lock = ::open(path("out/.lock").c_str(), O_CREAT | O_RDWR, 0666);
    ASSERT_EQ(::flock(lock, LOCK_EX), 0);
    EXPECT_THAT(error(), HasSubstr("another run is writing into"));
    ::close(lock);
    EXPECT_EQ(run().exit_code, 0);
    EXPECT_FALSE(fs::exists(path("out/.lock")));
}

TEST_F(RawlogLoopClosure, KeepsTheResultsBeforeAnInterruption)
{
    write_long_rawlog();
    const auto finished = run_and_send("INT", "-q");
    EXPECT_EQ(finished.exit_code, 1);
    EXPECT_THAT(finished.err, HasSubstr("interrupted; the results of the"));
    EXPECT_EQ(output_names(), kAllOutputs);
    EXPECT_EQ(summary()["ended_early"], "interrupted");
    EXPECT_GT(lines_of(frames_csv()).size(), 2U);
}

TEST_F(RawlogLoopClosure, DecidesTheFramesThatWaitWhenItIsInterrupted)
{
    write_long_rawlog();
    const auto finished =
        run_and_send("INT", "-q " + looking_ahead("1000"), "", {"costs.csv", "20,"});
    EXPECT_EQ(finished.exit_code, 1);
    EXPECT_THAT(finished.err, HasSubstr("interrupted; the results of the"));
    const auto rows = lines_of(frames_csv());
    EXPECT_EQ(rows.size(), lines_of(read_text(path("out/costs.csv"))).size());
    ASSERT_GT(rows.size(), 20U);
    EXPECT_THAT(rows[20], StartsWith("19,"));
}

TEST_F(RawlogLoopClosure, LinksNoWxWidgets)
{
    const auto finished = fild::testing::run_command("ldd " + app());
    EXPECT_THAT(finished.out, HasSubstr("libmrpt-obs"));
    EXPECT_THAT(finished.out, Not(HasSubstr("libwx")));
}

}  // namespace
