// SPDX-License-Identifier: BSD-3-Clause
#include "onednn_network.h"

#include "onnx_file.h"

#include <algorithm>
#include <array>
#include <map>
#include <new>
#include <omp.h>
#include <oneapi/dnnl/dnnl.hpp>
#include <stdexcept>
#include <unordered_map>
#include <utility>

namespace fild
{
namespace
{
using dnnl::memory;
using Arguments = std::unordered_map<int, memory>;

constexpr std::size_t kMaxMapBytes = std::size_t{1} << 29U;

/** For as long as it lives, oneDNN works in the thread that calls it and starts no others: some of
 *  its convolutions split their sums by the number of threads, which changes the last digits. */
class OneThread
{
 public:
    OneThread() : before_(omp_get_max_threads()) { omp_set_num_threads(1); }
    OneThread(const OneThread&) = delete;
    OneThread& operator=(const OneThread&) = delete;
    ~OneThread() { omp_set_num_threads(before_); }

 private:
    int before_;
};

memory::dims to_dims(const MapShape& shape)
{
    return {1, shape.channels, shape.rows, shape.columns};
}

/** Memory for feature maps; reused once a map is no longer needed. */
class MapMemory
{
 public:
    explicit MapMemory(const dnnl::engine& engine) : engine_(engine) {}

    memory allocate(const memory::desc& description)
    {
        const auto bytes = description.get_size();
        auto best = free_.end();
        for (auto each = free_.begin(); each != free_.end(); ++each)
            if (size_of(*each) >= bytes && (best == free_.end() || size_of(*each) < size_of(*best)))
                best = each;
        if (best == free_.end()) return {description, engine_, new_block(bytes)};
        void* const block = *best;
        free_.erase(best);
        return {description, engine_, block};
    }

    void release(const memory& map) { free_.push_back(map.get_data_handle()); }

 private:
    std::size_t size_of(void* block) const { return blocks_.at(block).get_desc().get_size(); }

    void* new_block(std::size_t bytes)
    {
        total_ += bytes;
        if (total_ > kMaxMapBytes)
            throw std::runtime_error(
                "its maps take more than 512 MB; [global_descriptor] input_width and input_height "
                "make them smaller");
        const memory::desc description(
            {static_cast<memory::dim>(bytes)}, memory::data_type::u8, memory::format_tag::a);
        memory block(description, engine_);
        blocks_.emplace(block.get_data_handle(), block);
        return block.get_data_handle();
    }

    dnnl::engine engine_;
    std::unordered_map<void*, memory> blocks_;  ///< by their addresses
    std::vector<void*> free_;
    std::size_t total_ = 0;
};

/** What is computed, one after the other. Value type. */
struct Step
{
    dnnl::primitive primitive;
    Arguments arguments;
    memory::desc scratchpad;
};

/** A map between two steps. */
struct Value
{
    memory data;  ///< none when another map has taken its place
    MapShape shape;
    int uses = 0;  ///< by layers to come
};

/** An activation of oneDNN. Value type. */
struct Activation
{
    dnnl::algorithm algorithm;
    float alpha;
    float beta;
};

Activation activation_of(const Layer& layer)
{
    const Layer unbounded;
    if (layer.upper < unbounded.upper)
        return {dnnl::algorithm::eltwise_clip, layer.lower, layer.upper};
    if (layer.lower == 0) return {dnnl::algorithm::eltwise_relu, 0, 0};
    if (layer.lower == unbounded.lower) return {dnnl::algorithm::eltwise_linear, 1, 0};
    return {dnnl::algorithm::eltwise_clip, layer.lower, layer.upper};
}

bool is_bounded(const Layer& layer)
{
    return activation_of(layer).algorithm != dnnl::algorithm::eltwise_linear;
}

/** What comes after the sums of a layer. */
dnnl::primitive_attr attributes_of(const Layer& layer)
{
    dnnl::post_ops after;
    if (!layer.residual.empty()) after.append_sum(1);
    if (is_bounded(layer))
    {
        const auto activation = activation_of(layer);
        after.append_eltwise(1, activation.algorithm, activation.alpha, activation.beta);
    }
    dnnl::primitive_attr attributes;
    // The library's own scratchpad belongs to the thread that made the primitive.
    attributes.set_scratchpad_mode(dnnl::scratchpad_mode::user);
    attributes.set_post_ops(after);
    return attributes;
}

/** Everything that is needed to run a network. Value type. */
struct Program
{
    MapMemory maps;
    memory image;
    memory scratchpad;
    std::vector<Step> steps;
    std::vector<cv::Mat> outputs;
};

/** Makes a program of layers. */
class ProgramBuilder
{
 public:
    ProgramBuilder(const NetworkLayers& network, const MapShape& image, Precision precision)
        : precision_(precision), image_rows_(image.rows)
    {
        count_uses(network);
        program_.image = {plain(image, memory::data_type::f32), engine_};
        auto& input = values_[network.input];
        input.data = program_.image;
        input.shape = image;
        ++input.uses;  // by the next image
        program_.outputs.resize(network.outputs.size());
        for (const auto& layer : network.layers) add_layer(layer, network.outputs);
        add_scratchpad();
    }

    Program program() && { return std::move(program_); }

 private:
    void count_uses(const NetworkLayers& network)
    {
        for (const auto& layer : network.layers)
        {
            for (const auto& input : layer.inputs) ++values_[input].uses;
            if (!layer.residual.empty()) ++values_[layer.residual].uses;
        }
    }

    void add_layer(const Layer& layer, const std::vector<std::string>& wanted)
    {
        auto needed = layer.inputs;
        if (!layer.residual.empty()) needed.push_back(layer.residual);
        std::vector<MapShape> shapes;
        shapes.reserve(needed.size());
        for (const auto& name : needed) shapes.push_back(values_.at(name).shape);
        auto& made = values_[layer.output];
        made.shape = output_shape(layer, shapes);
        try
        {
            made.data = compute(layer, made.shape);
        }
        catch (const dnnl::error& error)
        {
            if (error.status == dnnl_out_of_memory) throw std::bad_alloc();
            throw std::runtime_error("layer '" + layer.name +
                                     "' is refused by oneDNN: " + error.what());
        }
        for (std::size_t i = 0; i < wanted.size(); ++i)
            if (wanted[i] == layer.output) add_output(i, made);
        for (const auto& name : needed)
            if (--values_.at(name).uses == 0) release(values_.at(name));
        if (made.uses == 0) release(made);
    }

    void release(Value& value)
    {
        if (value.data) program_.maps.release(value.data);
        value.data = {};
    }

    /** Adds a layer's steps. \return where its map will be. */
    memory compute(const Layer& layer, const MapShape& shape)
    {
        const auto& input = values_.at(layer.inputs.front());
        switch (layer.kind)
        {
            case Layer::Kind::convolution:
                return convolve(layer, input, shape);
            case Layer::Kind::addition:
                return add(layer, input, values_.at(layer.inputs.back()));
            case Layer::Kind::identity:
                return activate(layer, input);
            case Layer::Kind::mean:
                return average(layer, input, shape);
            case Layer::Kind::flattening:
                break;
        }
        return flatten(input, shape);
    }

    void add_step(const dnnl::primitive_desc_base& description, Arguments arguments)
    {
        program_.steps.push_back({dnnl::primitive(description.get()),
                                  std::move(arguments),
                                  description.scratchpad_desc()});
    }

    void add_reorder(const memory& from, const memory& to)
    {
        dnnl::primitive_attr attributes;
        attributes.set_scratchpad_mode(dnnl::scratchpad_mode::user);
        add_step(dnnl::reorder::primitive_desc(from, to, attributes),
                 {{DNNL_ARG_FROM, from}, {DNNL_ARG_TO, to}});
    }

    static memory::desc plain(const MapShape& shape, memory::data_type type)
    {
        return {to_dims(shape), type, memory::format_tag::nchw};
    }

    static memory::desc any(const MapShape& shape, memory::data_type type)
    {
        return {to_dims(shape), type, memory::format_tag::any};
    }

    /** Of a convolution, by what it gives. Most of what bf16 loses it loses in the large maps. */
    memory::data_type type_of(const MapShape& output) const
    {
        const bool is_large = 8 * output.rows >= image_rows_;
        const bool exact =
            precision_ == Precision::f32 || (precision_ == Precision::mixed && is_large);
        return exact ? memory::data_type::f32 : memory::data_type::bf16;
    }

    void add_output(std::size_t i, const Value& value)
    {
        const auto& shape = value.shape;
        const std::array<int, 4> size{1,
                                      static_cast<int>(shape.channels),
                                      static_cast<int>(shape.rows),
                                      static_cast<int>(shape.columns)};
        program_.outputs[i].create(4, size.data(), CV_32F);
        add_reorder(value.data,
                    {plain(shape, memory::data_type::f32), engine_, program_.outputs[i].data});
    }

    /** The weights in the layout that the primitive wants. */
    memory stored(const std::vector<float>& numbers, const memory::desc& as, const memory::desc& to)
    {
        memory given(as, engine_);
        std::copy(numbers.begin(), numbers.end(), static_cast<float*>(given.get_data_handle()));
        if (as == to) return given;
        memory kept(to, engine_);
        dnnl::reorder(given, kept).execute(stream_, given, kept);
        stream_.wait();
        return kept;
    }

    dnnl::convolution_forward::primitive_desc describe(const Layer& layer,
                                                       const MapShape& input,
                                                       const MapShape& output,
                                                       const memory::dims& kernel) const
    {
        const auto& c = layer.convolution;
        const auto pads = pads_of(c, input);
        const auto type = type_of(output);
        return {{dnnl::prop_kind::forward_inference,
                 dnnl::algorithm::convolution_direct,
                 any(input, type),
                 {kernel, type, memory::format_tag::any},
                 {{c.outputs}, memory::data_type::f32, memory::format_tag::x},
                 any(output, type),
                 {c.strides[0], c.strides[1]},
                 {c.dilations[0] - 1, c.dilations[1] - 1},
                 {pads[0], pads[1]},
                 {pads[2], pads[3]}},
                attributes_of(layer),
                engine_};
    }

    memory convolve(const Layer& layer, const Value& input, const MapShape& shape)
    {
        const auto& c = layer.convolution;
        memory::dims kernel{
            c.outputs / c.groups, c.kernel.channels, c.kernel.rows, c.kernel.columns};
        if (c.groups > 1) kernel.insert(kernel.begin(), c.groups);
        const auto description = describe(layer, input.shape, shape, kernel);
        const auto tag = c.groups > 1 ? memory::format_tag::goihw : memory::format_tag::oihw;
        const auto weights =
            stored(c.weights, {kernel, memory::data_type::f32, tag}, description.weights_desc());
        const auto bias = stored(c.bias, description.bias_desc(), description.bias_desc());
        const bool fits = input.data.get_desc() == description.src_desc();
        const auto source = fits ? input.data : reordered(input.data, description.src_desc());
        auto result = layer.residual.empty() ? program_.maps.allocate(description.dst_desc())
                                             : summand(layer, description.dst_desc());
        add_step(description,
                 {{DNNL_ARG_SRC, source},
                  {DNNL_ARG_WEIGHTS, weights},
                  {DNNL_ARG_BIAS, bias},
                  {DNNL_ARG_DST, result}});
        if (!fits) program_.maps.release(source);
        return result;
    }

    memory reordered(const memory& from, const memory::desc& to)
    {
        auto other = program_.maps.allocate(to);
        add_reorder(from, other);
        return other;
    }

    /** The residual, to which the convolution adds: itself, or a copy when it is needed later. */
    memory summand(const Layer& layer, const memory::desc& description)
    {
        auto& residual = values_.at(layer.residual);
        if (residual.uses > 1 || residual.data.get_desc() != description)
            return reordered(residual.data, description);
        return std::exchange(residual.data, {});
    }

    memory add(const Layer& layer, const Value& one, const Value& other)
    {
        const auto description = one.data.get_desc();
        const bool fits = other.data.get_desc() == description;
        const auto second = fits ? other.data : reordered(other.data, description);
        auto result = program_.maps.allocate(description);
        add_step(dnnl::binary::primitive_desc(
                     {dnnl::algorithm::binary_add, description, description, description},
                     attributes_of(layer),
                     engine_),
                 {{DNNL_ARG_SRC_0, one.data}, {DNNL_ARG_SRC_1, second}, {DNNL_ARG_DST, result}});
        if (!fits) program_.maps.release(second);
        return result;
    }

    memory activate(const Layer& layer, const Value& input)
    {
        const auto description = input.data.get_desc();
        auto result = program_.maps.allocate(description);
        const auto activation = activation_of(layer);
        add_step(dnnl::eltwise_forward::primitive_desc({dnnl::prop_kind::forward_inference,
                                                        activation.algorithm,
                                                        description,
                                                        activation.alpha,
                                                        activation.beta},
                                                       attributes_of(Layer()),
                                                       engine_),
                 {{DNNL_ARG_SRC, input.data}, {DNNL_ARG_DST, result}});
        return result;
    }

    memory average(const Layer& layer, const Value& input, const MapShape& shape)
    {
        const dnnl::pooling_forward::primitive_desc description(
            {dnnl::prop_kind::forward_inference,
             dnnl::algorithm::pooling_avg_exclude_padding,
             input.data.get_desc(),
             any(shape, input.data.get_desc().data_type()),
             {1, 1},
             {input.shape.rows, input.shape.columns},
             {0, 0},
             {0, 0}},
            attributes_of(layer),
            engine_);
        auto result = program_.maps.allocate(description.dst_desc());
        add_step(description, {{DNNL_ARG_SRC, input.data}, {DNNL_ARG_DST, result}});
        return result;
    }

    memory flatten(const Value& input, const MapShape& shape)
    {
        const auto type = input.data.get_desc().data_type();
        const auto map = reordered(input.data, plain(input.shape, type));
        return {plain(shape, type), engine_, map.get_data_handle()};
    }

    /** One for all, for they run one after the other. */
    void add_scratchpad()
    {
        std::size_t bytes = 0;
        for (const auto& step : program_.steps) bytes = std::max(bytes, step.scratchpad.get_size());
        if (bytes == 0) return;
        program_.scratchpad = {
            {{static_cast<memory::dim>(bytes)}, memory::data_type::u8, memory::format_tag::a},
            engine_};
        for (auto& step : program_.steps)
            step.arguments.emplace(
                DNNL_ARG_SCRATCHPAD,
                memory(step.scratchpad, engine_, program_.scratchpad.get_data_handle()));
    }

    Precision precision_;
    std::int64_t image_rows_;
    dnnl::engine engine_{dnnl::engine::kind::cpu, 0};
    dnnl::stream stream_{engine_};
    std::map<std::string, Value> values_;
    Program program_{MapMemory(engine_), {}, {}, {}, {}};
};

class OneDnnNetwork : public Network
{
 public:
    explicit OneDnnNetwork(Program program)
        : program_(std::move(program)), stream_(program_.image.get_engine())
    {
    }

    std::vector<cv::Mat> forward(const cv::Mat& blob) override
    {
        const OneThread one_thread;
        const auto* const pixels = blob.ptr<float>();
        std::copy(
            pixels, pixels + blob.total(), static_cast<float*>(program_.image.get_data_handle()));
        for (const auto& step : program_.steps) step.primitive.execute(stream_, step.arguments);
        stream_.wait();
        return program_.outputs;
    }

 private:
    Program program_;
    dnnl::stream stream_;
};
}  // namespace

bool processor_has_bf16()
{
    const auto has = static_cast<unsigned>(dnnl::get_effective_cpu_isa());
    const auto needed = static_cast<unsigned>(dnnl::cpu_isa::avx512_core_bf16);
    return (has & needed) == needed;
}

std::unique_ptr<Network> read_onednn_network(const TGlobalDescriptorOptions& options)
{
    if (options.precision != Precision::f32 && !processor_has_bf16())
        throw std::runtime_error(
            "[global_descriptor] precision: this processor has no instructions for bf16; set "
            "precision = f32");
    const auto layers = read_onnx_layers(options);
    const MapShape image{3, options.input_height, options.input_width};
    try
    {
        const OneThread one_thread;
        return std::make_unique<OneDnnNetwork>(
            ProgramBuilder(layers, image, options.precision).program());
    }
    catch (const std::runtime_error& error)
    {
        refuse_file(options, error);
    }
}

}  // namespace fild
