// SPDX-License-Identifier: BSD-3-Clause
#include "fild/results/costs_csv.h"

#include "fild/core/process_memory.h"
#include "temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <sys/resource.h>
#include <vector>

namespace
{
std::string text_of(const std::vector<fild::CostRow>& rows)
{
    const fild::testing::TemporaryFolder folder;
    fild::CsvWriter<fild::CostRow> csv(folder.path("costs.csv"), fild::costs_csv_columns());
    for (const auto& row : rows) csv.add(row);
    csv.commit();
    return fild::testing::read_text(folder.path("costs.csv"));
}

constexpr const char* kHeader =
    "frame,image_decoding_ms,global_descriptor_ms,local_features_ms,hashing_ms,depth_ms,"
    "index_insertion_ms,index_search_ms,cells_ms,matching_ms,verification_ms,evidence_ms,"
    "relative_pose_ms,whole_frame_ms,map_bytes,resident_bytes\n";

TEST(CostsCsv, HasWhatEachFrameTook)
{
    fild::CostRow row;
    row.frame = fild::FrameId{7};
    row.stage_ms = {0, 0, 0, 2, 0, 0, 0, 0, 3.0004, 0, 0, 0, 7.25};
    row.map_bytes = 1000;
    EXPECT_EQ(text_of({row}),
              std::string(kHeader) +
                  "7,0.000,0.000,0.000,2.000,0.000,0.000,0.000,0.000,3.000,0.000,0.000,0.000,"
                  "7.250,1000,\n")
        << "memory is left out where it is not known";
    row.resident_bytes = 12345;
    EXPECT_THAT(text_of({row}), ::testing::EndsWith(",1000,12345\n"));
}

TEST(ReadCostsCsv, ReadsRowsAtEvenDistances)
{
    std::vector<fild::CostRow> rows(101);
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i].frame = fild::FrameId{i};
    rows[50].resident_bytes = 5;
    const fild::testing::TemporaryFolder folder;
    fild::testing::write_text(folder.path("costs.csv"), text_of(rows));
    EXPECT_EQ(fild::read_costs_csv(folder.path("costs.csv"), 1000).size(), 101U);
    const auto read = fild::read_costs_csv(folder.path("costs.csv"), 3);
    ASSERT_EQ(read.size(), 3U);
    EXPECT_EQ(read[0].frame, fild::FrameId{0});
    EXPECT_EQ(read[1].frame, fild::FrameId{50});
    EXPECT_EQ(read[1].resident_bytes, 5U);
    EXPECT_EQ(read[2].frame, fild::FrameId{100});
}

TEST(ProcessMemory, IsAtMostItsPeak)
{
    const auto resident = fild::resident_memory_bytes().value();
    EXPECT_GT(resident, 100000U);
    EXPECT_GE(fild::peak_memory_bytes() * 11 / 10, resident);  // the kernel counts both coarsely
}

TEST(ProcessMemory, IsNotKnownWhereTheSystemDoesNotTell)
{
    rlimit limit{};
    ASSERT_EQ(::getrlimit(RLIMIT_NOFILE, &limit), 0);
    const rlimit none{0, limit.rlim_max};
    ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &none), 0);
    const auto resident = fild::resident_memory_bytes();  // /proc/self/statm cannot be opened
    ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &limit), 0);
    EXPECT_FALSE(resident);
}

}  // namespace
