#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests of datasets-scripts/tflite_to_onnx.py against numpy convolutions with TFLite's semantics.

Needs Debian's python3-flatbuffers, python3-numpy, python3-onnx and python3-opencv (which runs the result, as the
project does). No network.
"""

import importlib.util
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import cv2
import flatbuffers
import numpy as np
import onnx

REPOSITORY = Path(__file__).resolve().parents[2]
SCRIPT = REPOSITORY / "datasets-scripts" / "tflite_to_onnx.py"
IMAGENET_MODEL = REPOSITORY.parent / "shared/data/models/mobilenet_v2_1.0_224_imagenet_int8.tflite"

sys.dont_write_bytecode = True
_spec = importlib.util.spec_from_file_location("tflite_to_onnx", SCRIPT)
tflite_to_onnx = importlib.util.module_from_spec(_spec)
sys.modules["tflite_to_onnx"] = tflite_to_onnx  # dataclasses look their module up
_spec.loader.exec_module(tflite_to_onnx)

# Numbers of the TFLite schema, written down a second time: an error in the script's must not cancel out.
ADD, CONV_2D, DEPTHWISE, DEQUANTIZE, LOGISTIC, RESHAPE, SOFTMAX, MEAN, QUANTIZE = 0, 3, 4, 6, 14, 22, 25, 40, 114
SAME, VALID = 0, 1
NONE, RELU, RELU6 = 0, 1, 3
TYPES = {"float32": 0, "float16": 1, "int32": 2, "uint8": 3, "int8": 9}


# ------------------------------------------------------------------------------------ writing a TFLite file


def write_table(builder, fields):
    """fields: {position: (kind, value)}; kind is 'Int8', 'Float32'... or 'Offset' of something written before."""
    builder.StartObject(max(fields, default=-1) + 1)
    for position, (kind, value) in fields.items():
        if kind == "Offset":
            builder.PrependUOffsetTRelativeSlot(position, value, 0)
        else:
            getattr(builder, f"Prepend{kind}Slot")(position, value, 0)
    return builder.EndObject()


def write_offsets(builder, offsets):
    builder.StartVector(4, len(offsets), 4)
    for offset in reversed(offsets):
        builder.PrependUOffsetTRelative(offset)
    return builder.EndVector()


def numbers(builder, values, dtype):
    return "Offset", builder.CreateNumpyVector(np.asarray(values, dtype))


class TfliteFile:
    """A network under construction; tensors are referred to by the index that tensor() returns."""

    def __init__(self):
        self.tensors, self.operators = [], []

    def tensor(self, name, shape, dtype="float32", data=None, scale=(), zero_point=(), axis=0):
        self.tensors.append((name, shape, dtype, data, scale, zero_point, axis))
        return len(self.tensors) - 1

    def constant(self, name, data, **quantization):
        return self.tensor(name, data.shape, data.dtype.name, data, **quantization)

    def operator(self, code, inputs, output, options=None):
        self.operators.append((code, inputs, output, options or {}))
        return output

    def to_bytes(self, inputs, outputs):
        b = flatbuffers.Builder(1024)
        buffers = [write_table(b, {})]
        tensors = []
        for name, shape, dtype, data, scale, zero_point, axis in self.tensors:
            buffer = 0
            if data is not None:
                buffer = len(buffers)
                buffers.append(write_table(b, {0: numbers(b, np.frombuffer(data.tobytes(), np.uint8), np.uint8)}))
            fields = {
                0: numbers(b, shape, np.int32),
                1: ("Int8", TYPES[dtype]),
                2: ("Uint32", buffer),
                3: ("Offset", b.CreateString(name)),
            }
            if len(scale):
                quantization = {
                    2: numbers(b, scale, np.float32),
                    3: numbers(b, zero_point, np.int64),
                    6: ("Int32", axis),
                }
                fields[4] = ("Offset", write_table(b, quantization))
            tensors.append(write_table(b, fields))
        codes = sorted({code for code, *_ in self.operators})
        operators = []
        for code, operator_inputs, output, options in self.operators:
            fields = {
                0: ("Uint32", codes.index(code)),
                1: numbers(b, operator_inputs, np.int32),
                2: numbers(b, [output], np.int32),
                4: ("Offset", write_table(b, options)),
            }
            operators.append(write_table(b, fields))
        graph = {
            0: ("Offset", write_offsets(b, tensors)),
            1: numbers(b, inputs, np.int32),
            2: numbers(b, outputs, np.int32),
            3: ("Offset", write_offsets(b, operators)),
        }
        graphs = write_offsets(b, [write_table(b, graph)])
        codes = write_offsets(b, [write_table(b, {0: ("Int8", c), 3: ("Int32", c)}) for c in codes])
        model = {
            0: ("Uint32", 3),
            1: ("Offset", codes),
            2: ("Offset", graphs),
            4: ("Offset", write_offsets(b, buffers)),
        }
        b.Finish(write_table(b, model), file_identifier=b"TFL3")
        return bytes(b.Output())


def conv_options(padding, stride, activation):
    return {0: ("Int8", padding), 1: ("Int32", stride), 2: ("Int32", stride), 3: ("Int8", activation)}


def depthwise_options(padding, stride, activation):
    return {
        0: ("Int8", padding),
        1: ("Int32", stride),
        2: ("Int32", stride),
        3: ("Int32", 1),
        4: ("Int8", activation),
    }


# ------------------------------------------------------------------------------------ TFLite's semantics in numpy


def activate(values, activation):
    if activation == NONE:
        return values
    return np.clip(values, 0, 6 if activation == RELU6 else None)


def windows(image, kernel, stride, padding):
    """Yields (row, column, window) of an NHWC image with one batch, padded as TFLite does."""
    _, height, width, _ = image.shape
    if padding == SAME:
        pads = []
        for size in (height, width):
            total = max((int(np.ceil(size / stride)) - 1) * stride + kernel - size, 0)
            pads.append((total // 2, total - total // 2))
        image = np.pad(image, [(0, 0), *pads, (0, 0)])
    for row in range((image.shape[1] - kernel) // stride + 1):
        for column in range((image.shape[2] - kernel) // stride + 1):
            y, x = row * stride, column * stride
            yield row, column, image[0, y : y + kernel, x : x + kernel]


def convolve(image, weights, bias, stride, padding, activation, depthwise=False):
    """weights: outputs, height, width, inputs; depthwise: 1, height, width, channels."""
    equation = "yxc,yxc->c" if depthwise else "yxi,oyxi->o"
    kernel = weights[0] if depthwise else weights
    cells = {
        (row, column): np.einsum(equation, window, kernel) + bias
        for row, column, window in windows(image, weights.shape[1], stride, padding)
    }
    rows, columns = (max(index) + 1 for index in zip(*cells))
    result = np.array([[cells[r, c] for c in range(columns)] for r in range(rows)])[None]
    return activate(result, activation)


# ------------------------------------------------------------------------------------ the tiny network


def store_float32(file, name, values, axis):
    return file.constant(name, values.astype(np.float32)), values.astype(np.float32)


def store_float16(file, name, values, axis):
    half = file.constant(name, values.astype(np.float16))
    full = file.tensor(name + "_dequantize", values.shape)
    file.operator(DEQUANTIZE, [half], full)
    return full, values.astype(np.float16).astype(np.float32)


def store_integers(file, name, values, axis, per_channel):
    """Weights as int8, biases (one axis) as int32, as TFLite does; returns the tensor and its real values."""
    is_bias = values.ndim == 1
    dtype, steps = (np.int32, 2**20) if is_bias else (np.int8, 127)
    others = tuple(i for i in range(values.ndim) if i != axis)
    scale = np.abs(values).max(axis=others if per_channel else None, keepdims=True) / steps
    scale = np.maximum(scale, 1e-6).astype(np.float32)
    zero_point = 0 if is_bias or per_channel else 3
    quantized = np.clip(np.round(values / scale) + zero_point, -128 if not is_bias else -(2**31), steps).astype(dtype)
    index = file.constant(
        name, quantized, scale=scale.ravel(), zero_point=[zero_point] * scale.size, axis=axis
    )
    return index, (quantized.astype(np.float64) - zero_point) * scale


def store_per_channel(file, name, values, axis):
    return store_integers(file, name, values, axis, per_channel=True)


def store_per_tensor(file, name, values, axis):
    return store_integers(file, name, values, axis, per_channel=False)


def make_tiny_network(store):
    """A stride 2 convolution, a depthwise one, their sum and a 1x1 convolution.

    Returns the file's bytes, the input image (NHWC) and the expected activations by name. The image is 9 x 8, so
    that SAME pads both sides of one dimension and one side of the other.
    """
    rng = np.random.default_rng(7)
    image = rng.uniform(-1, 1, (1, 9, 8, 3)).astype(np.float32)
    file = TfliteFile()
    source = file.tensor("image", image.shape)

    conv_w, conv_w_real = store(file, "conv/w", rng.normal(0, 2, (4, 3, 3, 3)), axis=0)
    conv_b, conv_b_real = store(file, "conv/b", rng.normal(0, 1, 4), axis=0)
    conv = file.tensor("conv/Relu6;conv/BatchNorm;conv/Conv2D", (1, 5, 4, 4))
    file.operator(CONV_2D, [source, conv_w, conv_b], conv, conv_options(SAME, 2, RELU6))
    conv_real = convolve(image, conv_w_real, conv_b_real, 2, SAME, RELU6)

    deep_w, deep_w_real = store(file, "deep/w", rng.normal(0, 1, (1, 3, 3, 4)), axis=3)
    deep_b, deep_b_real = store(file, "deep/b", rng.normal(0, 1, 4), axis=0)
    deep = file.tensor("deep/Relu6;deep/depthwise", (1, 5, 4, 4))
    file.operator(DEPTHWISE, [conv, deep_w, deep_b], deep, depthwise_options(SAME, 1, RELU6))
    deep_real = convolve(conv_real, deep_w_real, deep_b_real, 1, SAME, RELU6, depthwise=True)

    total = file.tensor("sum/add", (1, 5, 4, 4))
    file.operator(ADD, [conv, deep], total, {0: ("Int8", NONE)})

    last_w, last_w_real = store(file, "last/w", rng.normal(0, 1, (5, 1, 1, 4)), axis=0)
    last = file.tensor("last/Relu", (1, 5, 4, 5))
    file.operator(CONV_2D, [total, last_w], last, conv_options(VALID, 1, RELU))
    last_real = convolve(conv_real + deep_real, last_w_real, 0, 1, VALID, RELU)

    expected = {"conv/Relu6": conv_real, "deep/Relu6": deep_real, "sum/add": conv_real + deep_real}
    return file.to_bytes([source], [last]), image, {**expected, "last/Relu": last_real}


def run_onnx(model, image, layer):
    """Runs an ONNX model in OpenCV; the image and the result are NHWC where they have four dimensions."""
    net = cv2.dnn.readNetFromONNX(np.frombuffer(model.SerializeToString(), np.uint8))
    net.setInput(np.ascontiguousarray(image.transpose(0, 3, 1, 2)))
    result = net.forward(layer)
    return result.transpose(0, 2, 3, 1) if result.ndim == 4 else result


def convert(data, until=()):
    return tflite_to_onnx.convert(tflite_to_onnx.read_network(data), until)


class ConvertedNetwork(unittest.TestCase):
    def check_against_numpy(self, store):
        data, image, expected = make_tiny_network(store)
        model = convert(data, list(expected))
        self.assertEqual([o.name for o in model.graph.output], list(expected))
        for name, values in expected.items():
            for layer in (name, "onnx_node!" + name):
                with self.subTest(layer=layer):
                    np.testing.assert_allclose(run_onnx(model, image, layer), values, rtol=1e-4, atol=1e-4)

    def test_with_float32_constants_agrees_with_numpy(self):
        self.check_against_numpy(store_float32)

    def test_with_float16_constants_agrees_with_numpy(self):
        self.check_against_numpy(store_float16)

    def test_with_int8_constants_per_channel_agrees_with_numpy(self):
        self.check_against_numpy(store_per_channel)

    def test_with_int8_constants_per_tensor_agrees_with_numpy(self):
        self.check_against_numpy(store_per_tensor)

    def test_relu6_saturates_in_the_tiny_network(self):
        _, _, expected = make_tiny_network(store_float32)
        self.assertTrue((expected["conv/Relu6"] == 6).any() and (expected["conv/Relu6"] == 0).any())

    def test_ends_with_the_graphs_output_by_default(self):
        data, image, expected = make_tiny_network(store_float32)
        model = convert(data)
        self.assertEqual([o.name for o in model.graph.output], ["last/Relu"])
        np.testing.assert_allclose(run_onnx(model, image, None), expected["last/Relu"], rtol=1e-4, atol=1e-4)

    def test_leaves_out_what_lies_behind_the_cut(self):
        model = convert(make_tiny_network(store_float16)[0], ["conv/Relu6"])
        self.assertEqual([n.name for n in model.graph.node], ["conv/Relu6/linear", "conv/Relu6"])
        self.assertEqual([c.name for c in model.graph.initializer], ["conv/Relu6/weights", "conv/Relu6/bias"])

    def test_accepts_the_joined_name_too(self):
        model = convert(make_tiny_network(store_float32)[0], ["conv/Relu6;conv/BatchNorm;conv/Conv2D"])
        self.assertEqual(model.graph.output[0].name, "conv/Relu6")

    def test_is_the_same_every_time(self):
        data, *_ = make_tiny_network(store_per_channel)
        self.assertEqual(convert(data).SerializeToString(), convert(data).SerializeToString())


class ConvertedClassifier(unittest.TestCase):
    def test_pools_reshapes_and_normalises_as_numpy_does(self):
        image = np.random.default_rng(3).normal(0, 1, (1, 4, 4, 6)).astype(np.float32)
        file = TfliteFile()
        source = file.tensor("pixels", image.shape, "uint8", scale=[0.5], zero_point=[127])
        start = file.operator(QUANTIZE, [source], file.tensor("quantize", image.shape, "int8"))
        axes = file.constant("axes", np.array([1, 2], np.int32))
        mean = file.operator(MEAN, [start, axes], file.tensor("mean", (1, 1, 1, 6)), {0: ("Bool", True)})
        shape = file.constant("shape", np.array([1, 6], np.int32))
        flat = file.operator(RESHAPE, [mean, shape], file.tensor("flat", (1, 6)))
        soft = file.operator(SOFTMAX, [flat], file.tensor("soft", (1, 6)), {0: ("Float32", 1.0)})
        got = run_onnx(convert(file.to_bytes([source], [soft])), image, "soft")
        expected = np.exp(image.mean((1, 2)))
        np.testing.assert_allclose(got, expected / expected.sum(), rtol=1e-5)

    def test_reshapes_in_tflites_order_of_numbers(self):
        image = np.arange(2 * 3 * 4, dtype=np.float32).reshape(1, 2, 3, 4)
        file = TfliteFile()
        source = file.tensor("image", image.shape)
        shape = file.constant("shape", np.array([1, 24], np.int32))
        flat = file.operator(RESHAPE, [source, shape], file.tensor("flat", (1, 24)))
        got = run_onnx(convert(file.to_bytes([source], [flat])), image, "flat")
        np.testing.assert_array_equal(got, image.reshape(1, 24))


class SamePadding(unittest.TestCase):
    def test_puts_the_odd_pixel_after(self):
        self.assertEqual(tflite_to_onnx.same_padding(300, 3, 2, 1), (0, 1))
        self.assertEqual(tflite_to_onnx.same_padding(75, 3, 2, 1), (1, 1))
        self.assertEqual(tflite_to_onnx.same_padding(10, 3, 1, 1), (1, 1))
        self.assertEqual(tflite_to_onnx.same_padding(10, 3, 1, 2), (2, 2))
        self.assertEqual(tflite_to_onnx.same_padding(10, 1, 2, 1), (0, 0))


class CommandLine(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def run_script(self, data, *arguments):
        (self.folder / "in.tflite").write_bytes(data)
        command = [sys.executable, SCRIPT, self.folder / "in.tflite", self.folder / "out.onnx", *arguments]
        return subprocess.run(command, capture_output=True, text=True, check=False)

    def check_refused(self, data, *arguments, says):
        """Exit code 1, one line that has `says` in it, and no file left."""
        result = self.run_script(data, *arguments)
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertIn(says, result.stderr)
        self.assertEqual(result.stderr.count("\n"), 1, result.stderr)
        self.assertEqual(os.listdir(self.folder), ["in.tflite"])

    def test_writes_a_valid_onnx_file_and_says_what_is_in_it(self):
        result = self.run_script(make_tiny_network(store_per_channel)[0], "--until", "sum/add")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertIn("input  image: 1x3x9x8", result.stdout)
        self.assertIn("output sum/add: 1x4x5x4", result.stdout)
        onnx.checker.check_model(onnx.load(str(self.folder / "out.onnx")))
        self.assertEqual(sorted(os.listdir(self.folder)), ["in.tflite", "out.onnx"])

    def test_names_an_operator_that_it_cannot_convert(self):
        file = TfliteFile()
        source = file.tensor("image", (1, 2, 2, 1))
        output = file.operator(LOGISTIC, [source], file.tensor("odds/Sigmoid", (1, 2, 2, 1)))
        self.check_refused(file.to_bytes([source], [output]), says="operator LOGISTIC, which computes 'odds/Sigmoid'")

    def test_ignores_such_an_operator_behind_the_cut(self):
        file = TfliteFile()
        source = file.tensor("image", (1, 2, 2, 1))
        twice = file.operator(ADD, [source, source], file.tensor("twice", (1, 2, 2, 1)))
        output = file.operator(LOGISTIC, [twice], file.tensor("odds", (1, 2, 2, 1)))
        data = file.to_bytes([source], [output])
        self.assertEqual([n.op_type for n in convert(data, ["twice"]).graph.node], ["Add"])

    def test_lists_near_names_for_an_unknown_tensor(self):
        data, *_ = make_tiny_network(store_float32)
        self.check_refused(data, "--until", "conv/Relu", says="'conv/Relu'; near: conv/Relu6")

    def test_refuses_a_file_cut_short_anywhere(self):
        data, *_ = make_tiny_network(store_per_channel)
        for size in range(0, len(data), 7):
            with self.assertRaises(tflite_to_onnx.ConversionError, msg=f"{size} of {len(data)} bytes"):
                convert(data[:size])
        self.check_refused(data[: len(data) // 2], says="damaged or truncated TFLite file")

    def test_refuses_what_is_not_tflite(self):
        self.check_refused(b"GIF89a, not a network", says="not a TFLite file")
        self.check_refused(b"", says="not a TFLite file")

    def test_refuses_a_batch(self):
        file = TfliteFile()
        source = file.tensor("image", (2, 2, 2, 1))
        output = file.operator(ADD, [source, source], file.tensor("twice", (2, 2, 2, 1)))
        self.check_refused(file.to_bytes([source], [output]), says="only batch size 1")

    def test_has_help_and_rejects_missing_arguments(self):
        helped = subprocess.run([sys.executable, SCRIPT, "--help"], capture_output=True, text=True, check=False)
        self.assertEqual(helped.returncode, 0)
        self.assertIn("--until", helped.stdout)
        missing = subprocess.run([sys.executable, SCRIPT], capture_output=True, text=True, check=False)
        self.assertEqual(missing.returncode, 2)


class ImagenetModel(unittest.TestCase):
    def test_gives_probabilities_and_bounded_activations(self):
        if not IMAGENET_MODEL.exists():
            self.skipTest(f"absent: {IMAGENET_MODEL}")
        layer = "MobileNetV2/Conv2d_18_1/relu6/Relu6"
        model = convert(IMAGENET_MODEL.read_bytes(), [layer, "Identity"])
        image = np.random.default_rng(1).uniform(-1, 1, (1, 224, 224, 3)).astype(np.float32)
        probabilities = run_onnx(model, image, "Identity")
        self.assertEqual(probabilities.shape, (1, 1001))
        self.assertAlmostEqual(float(probabilities.sum()), 1.0, places=4)
        activations = run_onnx(model, image, layer)
        self.assertEqual(activations.shape, (1, 7, 7, 1280))
        self.assertTrue(activations.min() >= 0 and 0 < activations.max() <= 6)


if __name__ == "__main__":
    unittest.main()
