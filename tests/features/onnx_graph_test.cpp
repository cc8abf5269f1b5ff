// SPDX-License-Identifier: BSD-3-Clause
#include "onnx_graph.h"

#include "message_of.h"
#include "temporary_folder.h"

#include <cstring>

namespace
{
using fild::testing::message_of;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

/** A field that holds bytes, of less than 128 bytes. */
std::string field(int number, const std::string& bytes)
{
    EXPECT_LT(bytes.size(), 128U);
    return std::string{static_cast<char>(number << 3 | 2), static_cast<char>(bytes.size())} + bytes;
}

/** A field that holds a whole number less than 128. */
std::string field(int number, int value)
{
    return {static_cast<char>(number << 3), static_cast<char>(value)};
}

std::string raw(const std::vector<float>& numbers)
{
    std::string bytes(numbers.size() * sizeof(float), '\0');
    std::memcpy(bytes.data(), numbers.data(), bytes.size());
    return bytes;
}

/** TensorProto 'w' of two numbers. */
std::string tensor(const std::string& numbers)
{
    return field(1, 2) + field(2, 1) + field(8, "w") + numbers;
}

/** ModelProto of one Relu of 'x' and a constant; 'w' is listed as an input, too. */
std::string model(const std::string& constant)
{
    const auto node = field(1, "x") + field(2, "y") + field(4, "Relu");
    return field(
        7,
        field(1, node) + field(5, constant) + field(11, field(1, "w")) + field(11, field(1, "x")));
}

std::string error_of(const std::string& bytes)
{
    return message_of<std::runtime_error>([&] { fild::parse_onnx(bytes); });
}

TEST(OnnxGraph, HasNodesConstantsAndTheInput)
{
    const auto graph = fild::parse_onnx(model(tensor(field(9, raw({1, 2})))));
    ASSERT_EQ(graph.nodes.size(), 1U);
    EXPECT_EQ(graph.nodes[0].name, "y");  // it has no name of its own
    EXPECT_EQ(graph.nodes[0].kind, "Relu");
    EXPECT_THAT(graph.nodes[0].inputs, ElementsAre("x"));
    EXPECT_THAT(graph.inputs, ElementsAre("x"));
    ASSERT_EQ(graph.constants.count("w"), 1U);
    EXPECT_THAT(graph.constants.at("w").shape, ElementsAre(2));
    EXPECT_THAT(graph.constants.at("w").reals, ElementsAre(1, 2));
}

TEST(OnnxGraph, ReadsRepeatedNumbersOneByOneOrTogether)
{
    const std::string one_by_one = "\x25" + raw({1}) + "\x25" + raw({2});  // field 4 of four bytes
    for (const auto& numbers : {field(4, raw({1, 2})), one_by_one})
        EXPECT_THAT(fild::parse_onnx(model(tensor(numbers))).constants.at("w").reals,
                    ElementsAre(1, 2));
    const auto packed_shape = field(1, "\x02\x01") + field(2, 1) + field(9, raw({1, 2}));
    EXPECT_THAT(fild::parse_onnx(model(packed_shape)).constants.at("").shape, ElementsAre(2, 1));
}

TEST(OnnxGraph, RefusesConstantsOfAnotherSizeThanTheirShape)
{
    EXPECT_THAT(error_of(model(tensor(field(9, raw({1, 2, 3}))))), HasSubstr("'w' has 3 numbers"));
    EXPECT_THAT(error_of(model(tensor(""))), HasSubstr("'w' has 0 numbers"));
    EXPECT_THAT(error_of(model(tensor(field(9, "12345")))), HasSubstr("within a number"));
    std::string huge;
    for (int i = 0; i < 10; ++i) huge += field(1, 127);
    EXPECT_THAT(error_of(model(huge + field(2, 1) + field(9, raw({1})))), HasSubstr("1 numbers"));
}

TEST(OnnxGraph, RefusesConstantsInAnotherFile)
{
    EXPECT_THAT(error_of(model(tensor(field(14, 1)))), HasSubstr("as one file"));
}

TEST(OnnxGraph, LeavesOutNumbersOfOtherTypes)
{
    const auto of_doubles = field(1, 1) + field(2, 11) + field(8, "w") + field(9, "12345678");
    const auto graph = fild::parse_onnx(model(of_doubles));
    EXPECT_TRUE(graph.constants.at("w").reals.empty());
    EXPECT_TRUE(graph.constants.at("w").integers.empty());
}

TEST(OnnxGraph, RefusesEveryFileThatEndsTooEarly)
{
    const auto whole = model(tensor(field(9, raw({1, 2}))));
    for (std::size_t size = 1; size < whole.size(); ++size)
        EXPECT_NE(error_of(whole.substr(0, size)), "") << size;
    EXPECT_THAT(error_of(""), HasSubstr("no network"));
}

TEST(OnnxGraph, RefusesFieldsOfAnotherType)
{
    EXPECT_THAT(error_of(field(7, 1)), HasSubstr("neither a text nor a message"));
    EXPECT_THAT(error_of(model(field(2, "x"))), HasSubstr("not a whole number"));
    EXPECT_THAT(error_of(std::string(12, '\xff')), HasSubstr("too many bytes"));
    EXPECT_THAT(error_of("\x0b"), HasSubstr("a field is of no type"));
}

TEST(OnnxGraph, ReadsTheTinyNetwork)
{
    const auto graph = fild::parse_onnx(fild::testing::read_text(FILD_TINY_NETWORK));
    ASSERT_EQ(graph.nodes.size(), 3U);
    EXPECT_EQ(graph.nodes[0].kind, "Conv");
    EXPECT_THAT(graph.nodes[0].attributes.at("kernel_shape").integers, ElementsAre(1, 1));
    EXPECT_THAT(graph.constants.at("weights").reals, ElementsAre(1, 0, 0, 0, 1, 2));
    EXPECT_THAT(graph.inputs, ElementsAre("input"));
}

}  // namespace
