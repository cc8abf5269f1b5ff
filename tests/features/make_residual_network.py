#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes a small network of all kinds of layers that the oneDNN backend supports, with random weights.

Input 1 x 3 x 20 x 24. Two inverted residuals of MobileNetV2 whose batch normalisation is not merged,
and what other exports have: paddings of all kinds, a constant as a node, a batch normalisation and an
activation that follow no convolution, sums of what is used elsewhere, too.

Usage: make_residual_network.py OUTPUT.onnx
"""
import sys

import numpy
import onnx
from onnx import helper, numpy_helper


class Writer:
    def __init__(self):
        self.random = numpy.random.RandomState(1)
        self.nodes = []
        self.constants = []

    def constant(self, name, values):
        self.constants.append(numpy_helper.from_array(numpy.asarray(values, numpy.float32), name))
        return name

    def node(self, kind, name, inputs, **attributes):
        self.nodes.append(helper.make_node(kind, inputs, [name], name=name, **attributes))
        return name

    def convolution(self, name, source, channels, outputs, size=1, bias=False, **attributes):
        channels //= attributes.get("group", 1)
        spread = (channels * size * size) ** -0.5
        weights = self.random.normal(0, spread, (outputs, channels, size, size))
        inputs = [source, self.constant(name + "/weights", weights)]
        if bias:
            inputs.append(self.constant(name + "/bias", self.random.normal(0, 0.5, outputs)))
        return self.node("Conv", name, inputs, kernel_shape=[size, size], **attributes)

    def normalization(self, name, source, channels):
        inputs = [source]
        for part, values in (
            ("scale", self.random.uniform(0.5, 2, channels)),
            ("bias", self.random.normal(0, 0.5, channels)),
            ("mean", self.random.normal(0, 0.5, channels)),
            ("variance", self.random.uniform(0.2, 2, channels)),
        ):
            inputs.append(self.constant(f"{name}/{part}", values))
        return self.node("BatchNormalization", name, inputs, epsilon=0.001)

    def relu6(self, name, source):
        # Bounds are inputs from operator set 11 on, which OpenCV 4.6 does not read.
        return self.node("Clip", name, [source], min=0.0, max=6.0)

    def inverted_residual(self, name, source, channels, outputs, **depthwise):
        wide = 4 * channels
        x = self.convolution(name + "/expand", source, channels, wide)
        x = self.relu6(name + "/expand/relu6", self.normalization(name + "/expand/bn", x, wide))
        x = self.convolution(name + "/depthwise", x, wide, wide, 3, group=wide, **depthwise)
        x = self.relu6(name + "/depthwise/relu6", self.normalization(name + "/depthwise/bn", x, wide))
        x = self.convolution(name + "/project", x, wide, outputs)
        x = self.normalization(name + "/project/bn", x, outputs)
        return self.node("Add", name + "/add", [source, x]) if channels == outputs else x


def layers(writer):
    x = writer.convolution("first", "image", 3, 8, 3, bias=True, strides=[2, 2], pads=[0, 0, 1, 1])
    x = writer.node("Relu", "first/relu", [writer.normalization("first/bn", x, 8)])
    x = first = writer.inverted_residual("one", x, 8, 8, auto_pad="SAME_UPPER")
    x = second = writer.inverted_residual("two", x, 8, 12, pads=[1, 1, 0, 0], strides=[2, 2])
    x = writer.inverted_residual("three", x, 12, 12, pads=[2, 2, 2, 2], dilations=[2, 2])
    x = writer.node("Add", "again", [x, second])
    groups = writer.convolution("groups", first, 8, 12, 3, group=2, strides=[2, 2], pads=[1, 1, 1, 1])
    x = writer.node("Add", "sum", [writer.node("Relu", "groups/relu", [groups]), x])
    x = writer.normalization("alone/bn", x, 12)
    x = writer.node("Identity", "identity", [writer.relu6("alone/relu6", x)])
    x = writer.convolution("last", x, 12, 16, 3, pads=[1, 1, 1, 1], strides=[4, 4])
    writer.node("Flatten", "flat", [x])
    mean = writer.node("ReduceMean", "reduced", [x], axes=[2, 3], keepdims=1)
    shape = numpy_helper.from_array(numpy.array([1, -1], numpy.int64))
    writer.nodes.append(helper.make_node("Constant", [], ["shape"], name="shape", value=shape))
    writer.node("Reshape", "vector", [mean, "shape"])


def main():
    writer = Writer()
    layers(writer)
    graph = helper.make_graph(
        writer.nodes,
        "residual",
        [helper.make_tensor_value_info("image", onnx.TensorProto.FLOAT, [1, 3, 20, 24])],
        [helper.make_tensor_value_info("vector", onnx.TensorProto.FLOAT, [1, 16])],
        writer.constants,
    )
    model = helper.make_model(graph, opset_imports=[helper.make_opsetid("", 10)])
    model.ir_version = 7
    onnx.checker.check_model(model)
    onnx.save(model, sys.argv[1])


if __name__ == "__main__":
    main()
