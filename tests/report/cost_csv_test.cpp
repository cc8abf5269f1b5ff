// SPDX-License-Identifier: BSD-3-Clause
#include "fild/report/cost_csv.h"

#include "fild/report/process_memory.h"
#include "temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>
#include <sys/resource.h>

namespace
{
TEST(CostCsv, HasWhatEachFrameAdded)
{
    const fild::testing::TemporaryFolder folder;
    fild::StageTimes times;
    fild::CostCsv csv(folder.path("costs.csv"));
    times.add("hashing", 2);
    times.add("whole_frame", 5);
    csv.add(fild::FrameId{0}, times, 1000);
    times.add("matching", 1.5);
    times.add("matching", 1.5);
    times.add("whole_frame", 7.25);
    csv.add(fild::FrameId{1}, times, 2000);
    csv.commit();
    std::istringstream lines(fild::testing::read_text(folder.path("costs.csv")));
    std::string header;
    std::string first;
    std::string second;
    std::getline(lines, header);
    std::getline(lines, first);
    std::getline(lines, second);
    EXPECT_EQ(header,
              "frame,image_decoding_ms,global_descriptor_ms,local_features_ms,hashing_ms,depth_ms,"
              "index_insertion_ms,index_search_ms,cells_ms,matching_ms,verification_ms,evidence_ms,"
              "relative_"
              "pose_ms,"
              "whole_frame_ms,map_bytes,resident_bytes");
    EXPECT_THAT(first,
                ::testing::StartsWith("0,0.000,0.000,0.000,2.000,0.000,0.000,0.000,0.000,0.000,0."
                                      "000,0.000,0.000,5.000,1000,"));
    EXPECT_THAT(second,
                ::testing::StartsWith("1,0.000,0.000,0.000,0.000,0.000,0.000,0.000,0.000,3.000,0."
                                      "000,0.000,0.000,7.250,2000,"));
}

TEST(ProcessMemory, IsAtMostItsPeak)
{
    const auto resident = fild::resident_memory_bytes().value();
    EXPECT_GT(resident, 100000U);
    EXPECT_GE(fild::peak_memory_bytes() * 11 / 10, resident);  // the kernel counts both coarsely
}

TEST(CostCsv, LeavesOutMemoryThatTheSystemDoesNotTell)
{
    const fild::testing::TemporaryFolder folder;
    fild::CostCsv csv(folder.path("costs.csv"));
    rlimit limit{};
    ASSERT_EQ(::getrlimit(RLIMIT_NOFILE, &limit), 0);
    const rlimit none{0, limit.rlim_max};
    ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &none), 0);
    csv.add(fild::FrameId{0}, {}, 1000);  // /proc/self/statm cannot be opened
    ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &limit), 0);
    csv.commit();
    EXPECT_THAT(fild::testing::read_text(folder.path("costs.csv")),
                ::testing::EndsWith(",1000,\n"));
}

}  // namespace
