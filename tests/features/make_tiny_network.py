#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes a network small enough to check by hand, for the tests of the global descriptor.

Input 1 x 3 x 4 x 4. `map` (1 x 2 x 4 x 4): channel 0 is the input's channel 0, channel 1 is its
channel 1 plus twice its channel 2. `vector` (1 x 2): the mean of each channel of `map`.

Usage: make_tiny_network.py OUTPUT.onnx
"""
import sys

import numpy
import onnx
from onnx import helper, numpy_helper


def main():
    weights = numpy.array([[1, 0, 0], [0, 1, 2]], dtype=numpy.float32).reshape(2, 3, 1, 1)
    nodes = [
        helper.make_node("Conv", ["input", "weights"], ["map"], name="map", kernel_shape=[1, 1]),
        helper.make_node("GlobalAveragePool", ["map"], ["mean"], name="mean"),
        helper.make_node("Flatten", ["mean"], ["vector"], name="vector"),
    ]
    graph = helper.make_graph(
        nodes,
        "tiny",
        [helper.make_tensor_value_info("input", onnx.TensorProto.FLOAT, [1, 3, 4, 4])],
        [helper.make_tensor_value_info("vector", onnx.TensorProto.FLOAT, [1, 2])],
        [numpy_helper.from_array(weights, "weights")],
    )
    model = helper.make_model(graph, opset_imports=[helper.make_opsetid("", 11)])
    model.ir_version = 7
    onnx.save(model, sys.argv[1])


if __name__ == "__main__":
    main()
