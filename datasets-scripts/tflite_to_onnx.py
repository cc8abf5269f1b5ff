#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Converts a MobileNetV2-like TFLite network to ONNX that OpenCV 4.6 can read.

Each activation keeps its TensorFlow name. Where TFLite joined several names with ';' (it does when it
fuses layers) the first one is kept: it names the last of the fused steps, e.g. '.../Conv_1/Relu6'.
OpenCV 4.6 finds a graph output (see --until) under that name, and then runs the whole network; it finds any
layer as 'onnx_node!' + name, and then runs no layer behind it.

The result is a float32 network, NCHW, batch 1. float16 and quantised constants become float32; activations are
never quantised, so the rounding and saturation of an int8 network are not reproduced. The input takes real
values: the program prints how a quantised network's pixels map to them.

Operators: CONV_2D, DEPTHWISE_CONV_2D, ADD, MEAN (over height and width), RESHAPE, SOFTMAX, QUANTIZE,
DEQUANTIZE; fused RELU and RELU6. Anything else on the way to the requested tensors is an error.
"""
# Debian packages: python3-flatbuffers python3-numpy python3-onnx. OpenCV 4.6 dictates opset 10 (it reads
# the bounds of Clip from attributes only, and opset 11 made them inputs).

import argparse
import difflib
import os
import struct
import sys
import tempfile
from collections import Counter
from dataclasses import dataclass, field
from typing import Dict, List, Optional

import flatbuffers.encode
import flatbuffers.number_types as fb
import numpy as np
import onnx
from flatbuffers.table import Table
from onnx import helper, numpy_helper

OPSET = 10
IR_VERSION = 5  # the first to go with opset 10

# TFLite's schema (tensorflow/lite/schema/schema.fbs, version 3): the position of a field in its table, which
# fixes its place in the file, and the values of the enumerations. Only what is read here.
MODEL_OPERATOR_CODES, MODEL_SUBGRAPHS, MODEL_BUFFERS = 1, 2, 4
CODE_DEPRECATED_BUILTIN, CODE_BUILTIN = 0, 3  # 8 bits at first; the larger of the two is valid
SUBGRAPH_TENSORS, SUBGRAPH_INPUTS, SUBGRAPH_OUTPUTS, SUBGRAPH_OPERATORS = 0, 1, 2, 3
TENSOR_SHAPE, TENSOR_TYPE, TENSOR_BUFFER, TENSOR_NAME, TENSOR_QUANTIZATION = 0, 1, 2, 3, 4
QUANTIZATION_SCALE, QUANTIZATION_ZERO_POINT, QUANTIZATION_AXIS = 2, 3, 6
BUFFER_DATA = 0
OPERATOR_CODE_INDEX, OPERATOR_INPUTS, OPERATOR_OUTPUTS, OPERATOR_OPTIONS = 0, 1, 2, 4

TENSOR_DTYPES = {0: np.float32, 1: np.float16, 2: np.int32, 3: np.uint8, 4: np.int64, 7: np.int16, 9: np.int8}
PADDING_SAME, PADDING_VALID = 0, 1
ACTIVATION_NONE, ACTIVATION_RELU, ACTIVATION_RELU6 = 0, 1, 3

# Names of the builtin operators that image networks use, so that an error can name them.
OPERATOR_NAMES = {
    0: "ADD", 1: "AVERAGE_POOL_2D", 2: "CONCATENATION", 3: "CONV_2D", 4: "DEPTHWISE_CONV_2D", 6: "DEQUANTIZE",
    9: "FULLY_CONNECTED", 11: "L2_NORMALIZATION", 14: "LOGISTIC", 17: "MAX_POOL_2D", 18: "MUL", 19: "RELU",
    20: "RELU_N1_TO_1", 21: "RELU6", 22: "RESHAPE", 23: "RESIZE_BILINEAR", 25: "SOFTMAX", 28: "TANH",
    32: "CUSTOM", 34: "PAD", 39: "TRANSPOSE", 40: "MEAN", 41: "SUB", 43: "SQUEEZE", 54: "PRELU",
    97: "RESIZE_NEAREST_NEIGHBOR", 114: "QUANTIZE", 117: "HARD_SWISH",
}
# Options of an operator: name -> (field, type, the schema's default).
OPERATOR_OPTIONS_FIELDS = {
    "CONV_2D": {
        "padding": (0, fb.Int8Flags, PADDING_SAME),
        "stride_w": (1, fb.Int32Flags, 0),
        "stride_h": (2, fb.Int32Flags, 0),
        "activation": (3, fb.Int8Flags, ACTIVATION_NONE),
        "dilation_w": (4, fb.Int32Flags, 1),
        "dilation_h": (5, fb.Int32Flags, 1),
    },
    "DEPTHWISE_CONV_2D": {
        "padding": (0, fb.Int8Flags, PADDING_SAME),
        "stride_w": (1, fb.Int32Flags, 0),
        "stride_h": (2, fb.Int32Flags, 0),
        "activation": (4, fb.Int8Flags, ACTIVATION_NONE),
        "dilation_w": (5, fb.Int32Flags, 1),
        "dilation_h": (6, fb.Int32Flags, 1),
    },
    "ADD": {"activation": (0, fb.Int8Flags, ACTIVATION_NONE)},
    "MEAN": {"keep_dims": (0, fb.BoolFlags, False)},
    "SOFTMAX": {"beta": (0, fb.Float32Flags, 0.0)},
}


class ConversionError(Exception):
    """The input cannot be converted; the text says why."""


# ---------------------------------------------------------------------------------------------- reading TFLite


@dataclass
class Tensor:
    """A tensor of the TFLite graph; `data` is None for an activation."""

    name: str
    shape: List[int]
    data: Optional[np.ndarray]
    scales: np.ndarray  # empty: not quantised; one: per tensor; else one per index of `axis`
    zero_points: np.ndarray
    axis: int


@dataclass
class Operator:
    kind: str
    inputs: List[int]  # tensor indices; -1: optional input left out
    outputs: List[int]
    options: Dict[str, float]


@dataclass
class Network:
    tensors: List[Tensor]
    operators: List[Operator]
    inputs: List[int]
    outputs: List[int]


class FlatTable:
    """Reads fields of one flatbuffer table by their position in the schema."""

    def __init__(self, data, position):
        self._table = Table(data, position)

    @staticmethod
    def root(data):
        return FlatTable(data, flatbuffers.encode.Get(fb.UOffsetTFlags.packer_type, data, 0))

    def _offset(self, number):
        """Offset of a field from the table's start, 0 when absent; a vtable begins with two 2-byte sizes."""
        return self._table.Offset(4 + 2 * number)

    def scalar(self, number, flags, default):
        offset = self._offset(number)
        return self._table.Get(flags, self._table.Pos + offset) if offset else default

    def text(self, number):
        offset = self._offset(number)
        return self._table.String(self._table.Pos + offset).decode("utf-8") if offset else ""

    def table(self, number):
        offset = self._offset(number)
        return FlatTable(self._table.Bytes, self._table.Indirect(self._table.Pos + offset)) if offset else None

    def tables(self, number):
        offset = self._offset(number)
        if not offset:
            return []
        first = self._table.Vector(offset)
        return [
            FlatTable(self._table.Bytes, self._table.Indirect(first + 4 * i))
            for i in range(self._table.VectorLen(offset))
        ]

    def numbers(self, number, flags):
        offset = self._offset(number)
        if not offset or not self._table.VectorLen(offset):
            return np.empty(0, fb.to_numpy_type(flags))
        return self._table.GetVectorAsNumpy(flags, offset)


def read_network(data):
    """Parses a whole TFLite file (bytes) into a Network; ConversionError when it is not one."""
    if len(data) < 8 or data[4:8] != b"TFL3":
        raise ConversionError("not a TFLite file: the mark TFL3 is missing")
    try:
        return _read_model(FlatTable.root(bytearray(data)))
    except (struct.error, IndexError, TypeError, ValueError, OverflowError) as error:
        raise ConversionError(f"damaged or truncated TFLite file: {error}") from error


def _read_model(model):
    graphs = model.tables(MODEL_SUBGRAPHS)
    if len(graphs) != 1:
        raise ConversionError(f"{len(graphs)} subgraphs; only networks with one can be converted")
    graph = graphs[0]
    buffers = [b.numbers(BUFFER_DATA, fb.Uint8Flags) for b in model.tables(MODEL_BUFFERS)]
    kinds = [_read_operator_kind(code) for code in model.tables(MODEL_OPERATOR_CODES)]
    network = Network(
        tensors=[_read_tensor(t, buffers) for t in graph.tables(SUBGRAPH_TENSORS)],
        operators=[_read_operator(o, kinds) for o in graph.tables(SUBGRAPH_OPERATORS)],
        inputs=graph.numbers(SUBGRAPH_INPUTS, fb.Int32Flags).tolist(),
        outputs=graph.numbers(SUBGRAPH_OUTPUTS, fb.Int32Flags).tolist(),
    )
    referred = network.inputs + network.outputs + [i for o in network.operators for i in o.inputs + o.outputs]
    if max(referred, default=0) >= len(network.tensors):
        raise IndexError("a tensor that does not exist is referred to")
    return network


def _read_operator_kind(code):
    number = max(code.scalar(CODE_DEPRECATED_BUILTIN, fb.Int8Flags, 0), code.scalar(CODE_BUILTIN, fb.Int32Flags, 0))
    return OPERATOR_NAMES.get(number, f"builtin operator {number}")


def _read_tensor(table, buffers):
    name = table.text(TENSOR_NAME)
    shape = table.numbers(TENSOR_SHAPE, fb.Int32Flags).tolist()
    kind = table.scalar(TENSOR_TYPE, fb.Int8Flags, 0)
    raw = buffers[table.scalar(TENSOR_BUFFER, fb.Uint32Flags, 0)]
    data = None
    if raw.size:
        if kind not in TENSOR_DTYPES:
            raise ConversionError(f"constant '{name}' has the unsupported type {kind}")
        data = np.frombuffer(raw.tobytes(), TENSOR_DTYPES[kind]).reshape(shape)
    quantization = table.table(TENSOR_QUANTIZATION)
    if quantization is None:
        return Tensor(name, shape, data, np.empty(0), np.empty(0), 0)
    return Tensor(
        name,
        shape,
        data,
        scales=quantization.numbers(QUANTIZATION_SCALE, fb.Float32Flags),
        zero_points=quantization.numbers(QUANTIZATION_ZERO_POINT, fb.Int64Flags),
        axis=quantization.scalar(QUANTIZATION_AXIS, fb.Int32Flags, 0),
    )


def _read_operator(table, kinds):
    kind = kinds[table.scalar(OPERATOR_CODE_INDEX, fb.Uint32Flags, 0)]
    options = table.table(OPERATOR_OPTIONS)
    fields = OPERATOR_OPTIONS_FIELDS.get(kind, {})
    return Operator(
        kind,
        inputs=table.numbers(OPERATOR_INPUTS, fb.Int32Flags).tolist(),
        outputs=table.numbers(OPERATOR_OUTPUTS, fb.Int32Flags).tolist(),
        options={
            name: options.scalar(number, flags, default) if options else default
            for name, (number, flags, default) in fields.items()
        },
    )


def real_values(tensor):
    """The numbers a constant stands for: scale * (q - zero_point), float32; unquantised integers stay integers."""
    if not tensor.scales.size:
        return tensor.data.astype(np.float32) if tensor.data.dtype.kind == "f" else tensor.data
    along_axis = [1] * tensor.data.ndim
    if tensor.scales.size > 1:
        along_axis[tensor.axis] = tensor.scales.size
    scales = tensor.scales.astype(np.float64).reshape(along_axis)
    zero_points = tensor.zero_points if tensor.zero_points.size else np.zeros(tensor.scales.size)
    return ((tensor.data - zero_points.astype(np.float64).reshape(along_axis)) * scales).astype(np.float32)


# -------------------------------------------------------------------------------------------- choosing the part


def is_constant(network, operator):
    """A DEQUANTIZE of stored weights: files with float16 weights have one for each of them."""
    return operator.kind in ("DEQUANTIZE", "QUANTIZE") and network.tensors[operator.inputs[0]].data is not None


def computed_activations(network):
    """Indices of the tensors that depend on the input image, in the order they are computed."""
    return [i for operator in network.operators if not is_constant(network, operator) for i in operator.outputs]


def unique_names(network):
    """Names by tensor index: the first of the ';'-joined names, or all of them where that one is not unique."""
    first = [t.name.split(";")[0] for t in network.tensors]
    uses = Counter(first[i] for i in network.inputs + computed_activations(network))
    return [t.name if uses[name] > 1 else name for t, name in zip(network.tensors, first)]


def find_outputs(network, names, wanted):
    """Indices of the tensors called `wanted` (first or joined name), in the order they are computed."""
    computed = computed_activations(network)
    by_name = {network.tensors[i].name: i for i in computed}
    by_name.update({names[i]: i for i in computed})
    found = []
    for name in wanted:
        if name not in by_name:
            near = near_names(name, [names[i] for i in computed])
            hint = f"; near: {', '.join(near)}" if near else ""
            raise ConversionError(f"no layer computes a tensor named '{name}'{hint}")
        found.append(by_name[name])
    return sorted(set(found), key=computed.index)


def near_names(name, names):
    """Up to five of `names`: those that contain `name`, then those spelt alike."""
    containing = [n for n in names if name in n]
    alike = difflib.get_close_matches(name, names, n=5, cutoff=0.3)
    return list(dict.fromkeys(containing + alike))[:5]


def needed_operators(network, outputs):
    """The operators that the outputs depend on, in the order of the file, which is one of execution."""
    needed, operators = set(outputs), []
    for operator in reversed(network.operators):
        if needed.intersection(operator.outputs):
            needed.update(operator.inputs)
            operators.append(operator)
    return operators[::-1]


# ------------------------------------------------------------------------------------------------- writing ONNX


def same_padding(size, kernel, stride, dilation):
    """(before, after) of TFLite's SAME: ceil(size / stride) outputs, the odd pixel goes after."""
    outputs = -(-size // stride)
    total = max((outputs - 1) * stride + (kernel - 1) * dilation + 1 - size, 0)
    return total // 2, total - total // 2


def onnx_shape(shape):
    """TFLite's NHWC as NCHW; other ranks as they are."""
    return [shape[0], shape[3], shape[1], shape[2]] if len(shape) == 4 else shape


@dataclass
class OnnxWriter:
    """Collects ONNX nodes and constants. Rank-4 activations are NCHW, all others as in TFLite."""

    network: Network
    names: List[str]
    nodes: List[onnx.NodeProto] = field(default_factory=list)
    constants: List[onnx.TensorProto] = field(default_factory=list)
    dequantized: Dict[int, np.ndarray] = field(default_factory=dict)  # constants behind a DEQUANTIZE

    def convert(self, operator):
        method = self.METHODS.get(operator.kind)
        if method is None:
            raise ConversionError(
                f"operator {operator.kind}, which computes '{self.names[operator.outputs[0]]}', is not supported; "
                "--until an earlier tensor may leave it out"
            )
        method(self, operator)

    def _shape(self, index):
        """Shape as in TFLite: NHWC."""
        return self.network.tensors[index].shape

    def _value(self, index):
        """Real values of a constant, or None when `index` is an activation."""
        if index in self.dequantized:
            return self.dequantized[index]
        tensor = self.network.tensors[index]
        return None if tensor.data is None else real_values(tensor)

    def _constant(self, name, values):
        self.constants.append(numpy_helper.from_array(np.ascontiguousarray(values), name))
        return name

    def _node(self, kind, inputs, output, **attributes):
        # The node is called like its output: OpenCV's layer is then 'onnx_node!' + that name.
        self.nodes.append(helper.make_node(kind, inputs, [output], name=output, **attributes))
        return output

    def _activated(self, kind, inputs, output, activation, **attributes):
        """Emits a node and its fused activation; only the last of the two bears the name `output`."""
        if activation == ACTIVATION_NONE:
            self._node(kind, inputs, output, **attributes)
            return
        linear = self._node(kind, inputs, output + "/linear", **attributes)
        if activation == ACTIVATION_RELU:
            self._node("Relu", [linear], output)
        elif activation == ACTIVATION_RELU6:
            self._node("Clip", [linear], output, min=0.0, max=6.0)
        else:
            raise ConversionError(f"fused activation {activation} of '{output}' is not supported")

    def _pads(self, operator, kernel):
        """ONNX pads [top, left, bottom, right]."""
        options = operator.options
        if options["padding"] == PADDING_VALID:
            return [0, 0, 0, 0]
        _, height, width, _ = self._shape(operator.inputs[0])
        top, bottom = same_padding(height, kernel[0], options["stride_h"], options["dilation_h"])
        left, right = same_padding(width, kernel[1], options["stride_w"], options["dilation_w"])
        return [top, left, bottom, right]

    def _convolution(self, operator, weights, group):
        """Emits a Conv with `weights` in ONNX order: outputs, inputs per group, height, width."""
        output = self.names[operator.outputs[0]]
        inputs = [self.names[operator.inputs[0]], self._constant(output + "/weights", weights)]
        if len(operator.inputs) > 2 and operator.inputs[2] >= 0:
            inputs.append(self._constant(output + "/bias", self._value(operator.inputs[2])))
        kernel = list(weights.shape[2:])
        options = operator.options
        self._activated(
            "Conv",
            inputs,
            output,
            options["activation"],
            kernel_shape=kernel,
            strides=[options["stride_h"], options["stride_w"]],
            dilations=[options["dilation_h"], options["dilation_w"]],
            pads=self._pads(operator, kernel),
            group=group,
        )

    def _weights(self, operator):
        weights = self._value(operator.inputs[1])
        if weights is None:
            raise ConversionError(f"the weights of '{self.names[operator.outputs[0]]}' are not constant")
        return weights

    def _conv_2d(self, operator):
        weights = self._weights(operator).transpose(0, 3, 1, 2)  # from outputs, height, width, inputs
        self._convolution(operator, weights, group=self._shape(operator.inputs[0])[3] // weights.shape[1])

    def _depthwise_conv_2d(self, operator):
        weights = self._weights(operator).transpose(3, 0, 1, 2)  # from 1, height, width, outputs
        self._convolution(operator, weights, group=self._shape(operator.inputs[0])[3])

    def _add(self, operator):
        left, right = operator.inputs
        output = self.names[operator.outputs[0]]
        if self._value(left) is not None or self._value(right) is not None or self._shape(left) != self._shape(right):
            raise ConversionError(f"ADD '{output}' of anything but two activations of one shape is not supported")
        self._activated("Add", [self.names[left], self.names[right]], output, operator.options["activation"])

    def _mean(self, operator):
        output = self.names[operator.outputs[0]]
        axes = sorted(np.ravel(self._value(operator.inputs[1])).tolist())
        if len(self._shape(operator.inputs[0])) != 4 or axes != [1, 2]:
            raise ConversionError(f"MEAN '{output}' over anything but height and width is not supported")
        keep = int(operator.options["keep_dims"])
        self._node("ReduceMean", [self.names[operator.inputs[0]]], output, axes=[2, 3], keepdims=keep)

    def _reshape(self, operator):
        source, output = self.names[operator.inputs[0]], self.names[operator.outputs[0]]
        before, after = self._shape(operator.inputs[0]), self._shape(operator.outputs[0])
        if len(after) == 4:
            raise ConversionError(f"RESHAPE '{output}' to four dimensions is not supported")
        if len(before) == 4 and before[1] * before[2] > 1:  # the order of the numbers is TFLite's
            source = self._node("Transpose", [source], output + "/nhwc", perm=[0, 2, 3, 1])
        shape = self._constant(output + "/shape", np.array(after, np.int64))
        self._node("Reshape", [source, shape], output)

    def _softmax(self, operator):
        output = self.names[operator.outputs[0]]
        if len(self._shape(operator.inputs[0])) != 2 or operator.options["beta"] != 1.0:
            raise ConversionError(f"SOFTMAX '{output}' of other than two dimensions or beta 1 is not supported")
        self._node("Softmax", [self.names[operator.inputs[0]]], output, axis=1)

    def _requantize(self, operator):
        value = self._value(operator.inputs[0])
        if value is None:  # an activation: real values all the way, so only its name changes
            self._node("Identity", [self.names[operator.inputs[0]]], self.names[operator.outputs[0]])
        else:
            self.dequantized[operator.outputs[0]] = value

    METHODS = {
        "ADD": _add,
        "CONV_2D": _conv_2d,
        "DEPTHWISE_CONV_2D": _depthwise_conv_2d,
        "DEQUANTIZE": _requantize,
        "MEAN": _mean,
        "QUANTIZE": _requantize,
        "RESHAPE": _reshape,
        "SOFTMAX": _softmax,
    }


def convert(network, until=()):
    """Builds the ONNX model of the part of `network` that computes the tensors `until` (default: its outputs)."""
    names = unique_names(network)
    outputs = find_outputs(network, names, until) if until else network.outputs
    writer = OnnxWriter(network, names)
    operators = needed_operators(network, outputs)
    for operator in operators:
        writer.convert(operator)
    used = {i for operator in operators for i in operator.inputs}
    graph = helper.make_graph(
        writer.nodes,
        "tflite",
        [_value_info(network, names, i) for i in network.inputs if i in used],
        [_value_info(network, names, i) for i in outputs],
        writer.constants,
    )
    model = helper.make_model(
        graph,
        producer_name="mrpt-fild tflite_to_onnx",
        opset_imports=[helper.make_opsetid("", OPSET)],
        ir_version=IR_VERSION,
    )
    onnx.checker.check_model(model)
    return model


def _value_info(network, names, index):
    shape = onnx_shape(network.tensors[index].shape)
    if not shape or shape[0] != 1:
        raise ConversionError(f"'{names[index]}' has shape {shape}; only batch size 1 can be converted")
    return helper.make_tensor_value_info(names[index], onnx.TensorProto.FLOAT, shape)


# ------------------------------------------------------------------------------------------------- command line


def write_atomically(path, data):
    folder = os.path.dirname(os.path.abspath(path))
    descriptor, temporary = tempfile.mkstemp(dir=folder, prefix=os.path.basename(path) + ".")
    try:
        with os.fdopen(descriptor, "wb") as file:
            file.write(data)
        umask = os.umask(0)
        os.umask(umask)
        os.chmod(temporary, 0o666 & ~umask)  # mkstemp gives 0600
        os.replace(temporary, path)
    except BaseException:
        os.unlink(temporary)
        raise


def describe(network, model):
    """One line on each input and output for the user."""
    lines = []
    quantized = {t.name.split(";")[0]: t for t in network.tensors if t.scales.size == 1}
    for value in model.graph.input:
        shape = "x".join(str(d.dim_value) for d in value.type.tensor_type.shape.dim)
        line = f"input  {value.name}: {shape}"
        if value.name in quantized:
            tensor = quantized[value.name]
            line += f", {tensor.scales[0]:.6g} * (pixel - {tensor.zero_points[0]})"
        lines.append(line)
    for value in model.graph.output:
        shape = "x".join(str(d.dim_value) for d in value.type.tensor_type.shape.dim)
        lines.append(f"output {value.name}: {shape}")
    return "\n".join(lines)


def parse_arguments(arguments):
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("input", metavar="INPUT.tflite")
    parser.add_argument("output", metavar="OUTPUT.onnx")
    parser.add_argument(
        "--until",
        metavar="TENSOR_NAME",
        action="append",
        default=[],
        help="stop after this tensor and make it an output; may be repeated (default: the network's outputs)",
    )
    return parser.parse_args(arguments)


def main(arguments=None):
    options = parse_arguments(arguments)
    try:
        with open(options.input, "rb") as file:
            network = read_network(file.read())
        model = convert(network, options.until)
        write_atomically(options.output, model.SerializeToString(deterministic=True))
    except (ConversionError, OSError) as error:
        reason = f"{options.input}: {error}" if isinstance(error, ConversionError) else error
        print(f"tflite_to_onnx.py: error: {reason}", file=sys.stderr)
        return 1
    print(describe(network, model))
    return 0


if __name__ == "__main__":
    sys.exit(main())
