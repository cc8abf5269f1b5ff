// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace fild
{
/** Numbers that are stored in the file. Value type. */
struct OnnxTensor
{
    std::vector<std::int64_t> shape;
    /** One of the two holds as many numbers as the shape has; neither, when the numbers are of a
     *  type that no supported operator takes. */
    std::vector<float> reals;
    std::vector<std::int64_t> integers;
};

/** A setting of an operator; which field counts is up to the operator. Value type. */
struct OnnxAttribute
{
    std::int64_t integer = 0;
    float real = 0;
    std::string text;
    std::vector<std::int64_t> integers;
    std::vector<float> reals;
    std::optional<OnnxTensor> tensor;
};

/** An operator. Value type. */
struct OnnxNode
{
    std::string name;  ///< that of its first output if the file gives none
    std::string kind;
    std::vector<std::string> inputs;  ///< an empty name: left out
    std::vector<std::string> outputs;
    std::map<std::string, OnnxAttribute> attributes;
};

/** What an ONNX file holds of a network. Value type. */
struct OnnxGraph
{
    std::vector<OnnxNode> nodes;  ///< without those of the kind Constant
    std::map<std::string, OnnxTensor> constants;
    std::vector<std::string> inputs;  ///< constants not among them
};

/** \throw std::runtime_error with the reason when the bytes are no ONNX model. Memory and time are
 *  proportional to the size. */
OnnxGraph parse_onnx(std::string_view bytes);

}  // namespace fild
