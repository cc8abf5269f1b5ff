// SPDX-License-Identifier: BSD-3-Clause
#include "fild/evaluation/ground_truth.h"

#include "drawn_truth.h"
#include "mat_file.h"
#include "message_of.h"
#include "temporary_folder.h"

namespace
{
using fild::testing::frames_at_one_hertz;
using fild::testing::MatFile;
using fild::testing::message_of;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class GroundTruthFile : public ::testing::Test
{
 protected:
    std::string path() const { return folder_.path("truth"); }

    void write(const std::string& text) const { fild::testing::write_text(path(), text); }

    void write_matrix(const fild::testing::Cells& cells) const
    {
        MatFile(path()).full<double>("GT", MAT_C_DOUBLE, MAT_T_DOUBLE, 6, 6, cells);
    }

    fild::GroundTruth load(const std::string& protocol = "exact", std::size_t frames = 6) const
    {
        return fild::load_ground_truth(
            path(), frames_at_one_hertz(frames), fild::parse_protocol(protocol));
    }

    template <class Error = std::runtime_error>
    std::string error(const std::string& protocol = "exact", std::size_t frames = 6) const
    {
        return message_of<Error>([&] { load(protocol, frames); });
    }

 private:
    fild::testing::TemporaryFolder folder_;
};

TEST_F(GroundTruthFile, IsKnownByItsContent)
{
    write("# loops\n4 0\n5 0\n");
    EXPECT_EQ(load().content, "list of loops, 2 pairs");
    EXPECT_THAT(load().remarks, IsEmpty());
    write_matrix({{4, 0}});
    EXPECT_EQ(load("window:3").content, "loop matrix of 6 frames, 1 pair");
    write("0 0 0 0 0 0 0 1\n");
    EXPECT_EQ(load("radius:5").content, "TUM poses of 1 frame");
    EXPECT_THAT(load("radius:5").remarks, ElementsAre("5 frames have no pose"));
    write("1 0 0 0 0 1 0 0 0 0 1 0\n");
    EXPECT_EQ(load("radius:5", 1).content, "KITTI poses of 1 frame");
}

TEST_F(GroundTruthFile, SaysWhatWasOdd)
{
    write_matrix({{0, 4}, {0, 5}, {3, 1}, {2, 2}});
    EXPECT_THAT(load().remarks,
                ElementsAre(HasSubstr("stored transposed"),
                            HasSubstr("1 entry on the diagonal"),
                            HasSubstr("1 entry above the diagonal: a label error"),
                            HasSubstr("1 loop query has no other entry")));
    write_matrix({{4, 0}, {0, 4}});
    EXPECT_THAT(load().remarks, ElementsAre(HasSubstr("1 entry repeats")));
}

TEST_F(GroundTruthFile, OfAnotherRunIsRefused)
{
    write_matrix({{4, 0}});
    EXPECT_THAT(error("exact", 7), HasSubstr("labels 6 frames, the run has 7"));
    write("6 0\n");
    EXPECT_THAT(error(), HasSubstr("names frame 6, the run has 6 frames"));
}

TEST_F(GroundTruthFile, WithoutALoopIsRefused)
{
    write_matrix({});
    EXPECT_THAT(error(), HasSubstr("no loop in"));
    write_matrix({{3, 3}});
    EXPECT_THAT(error(), HasSubstr("no loop in"));
    write("# nothing\n");
    EXPECT_THAT(error(), HasSubstr("no loop and no pose in"));
}

TEST_F(GroundTruthFile, OfUnknownFormatIsRefused)
{
    EXPECT_THAT(error(), HasSubstr("no such ground-truth file"));
    write("1 2 3\n");
    EXPECT_THAT(error(), HasSubstr("line 1: 3 numbers"));
    write(std::string("\0\1\2", 3));
    EXPECT_THAT(error(), HasSubstr("neither a text file nor a MATLAB file"));
}

TEST_F(GroundTruthFile, NeedsItsProtocol)
{
    write("4 0\n");
    EXPECT_THAT(error<std::invalid_argument>("radius:5"), HasSubstr("exact or window:N"));
    write("0 0 0 0 0 0 0 1\n");
    EXPECT_THAT(error<std::invalid_argument>("exact"), HasSubstr("radius:R"));
}

}  // namespace
