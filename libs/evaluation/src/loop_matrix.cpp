// SPDX-License-Identifier: BSD-3-Clause
// The only file that sees matio.
#include "fild/core/trial_process.h"
#include "fild/evaluation/loop_labels.h"

#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <matio.h>
#include <memory>
#include <stdexcept>

namespace fild
{
namespace
{
using MatFile = std::unique_ptr<mat_t, decltype(&Mat_Close)>;
using MatVariable = std::unique_ptr<matvar_t, decltype(&Mat_VarFree)>;
using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;

MatFile open_mat_file(const std::string& path)
{
    MatFile file(Mat_Open(path.c_str(), MAT_ACC_RDONLY), &Mat_Close);
    if (!file) throw std::runtime_error("cannot read '" + path + "' as a MATLAB file");
    return file;
}

/** Does a MATLAB file of version 5 end within a variable? matio reads what is not there as 0. The
 *  file is a header of 128 bytes, then variables, each with its type and size in front. */
bool is_cut_off(const std::string& path)
{
    constexpr std::size_t kHeaderBytes = 128;
    std::ifstream file(path, std::ios::binary);
    std::array<char, kHeaderBytes> header{};
    file.read(header.data(), header.size());
    const bool little_endian = header[kHeaderBytes - 2] == 'I';
    const auto file_bytes = std::filesystem::file_size(path);
    std::uintmax_t end = kHeaderBytes;
    std::array<unsigned char, 8> tag{};
    while (file.seekg(static_cast<std::streamoff>(end)) && end < file_bytes)
    {
        if (!file.read(reinterpret_cast<char*>(tag.data()), tag.size())) return true;
        std::uintmax_t bytes = 0;
        for (std::size_t i = 0; i < 4; ++i)
            bytes = bytes * 256 + tag[little_endian ? 7 - i : 4 + i];
        end += tag.size() + bytes;
    }
    return end > file_bytes;
}

std::string describe(const matvar_t& variable)
{
    std::string size;
    for (int i = 0; i < variable.rank; ++i)
        size += (i == 0 ? "" : "x") + std::to_string(variable.dims[i]);
    return std::string(variable.name == nullptr ? "?" : variable.name) + " (" + size + ")";
}

bool is_number_class(matio_classes type)
{
    switch (type)
    {
        case MAT_C_SPARSE:
        case MAT_C_DOUBLE:
        case MAT_C_SINGLE:
        case MAT_C_INT8:
        case MAT_C_UINT8:
        case MAT_C_INT16:
        case MAT_C_UINT16:
        case MAT_C_INT32:
        case MAT_C_UINT32:
        case MAT_C_INT64:
        case MAT_C_UINT64:
            return true;
        default:
            return false;
    }
}

bool is_matrix(const matvar_t& variable)
{
    return variable.name != nullptr && is_number_class(variable.class_type) &&
           variable.isComplex == 0 && variable.rank == 2 && variable.dims[0] > 1 &&
           variable.dims[1] > 1;
}

/** Name of the only matrix of the file. */
std::string find_matrix(const std::string& path)
{
    const auto file = open_mat_file(path);
    if (Mat_GetVersion(file.get()) == MAT_FT_MAT5 && is_cut_off(path))
        throw std::runtime_error(path + " is cut off; fetch it again");
    std::string all;
    std::vector<std::string> matrices;
    while (const MatVariable variable{Mat_VarReadNextInfo(file.get()), &Mat_VarFree})
    {
        all += (all.empty() ? "" : ", ") + describe(*variable);
        if (is_matrix(*variable)) matrices.emplace_back(variable->name);
    }
    if (matrices.size() != 1)
        throw std::runtime_error(
            path + " holds " + (matrices.empty() ? "no matrix" : "more than one matrix") +
            " of real numbers; there must be exactly one, the loop matrix. It holds: " +
            (all.empty() ? "nothing" : all));
    return matrices[0];
}

/** Calls see(row, column) for each element i = 0, 1... that is not 0; place(i) is where it stands.
 *  \return false when an element is not a number (NaN). */
template <class Element, class Place, class See>
bool see_entries(const void* data, std::size_t count, Place&& place, See&& see)
{
    const auto* elements = static_cast<const Element*>(data);
    for (std::size_t i = 0; i < count; ++i)
    {
        if (elements[i] != elements[i]) return false;
        if (elements[i] != 0) see(place(i));
    }
    return true;
}

/** As above, for whichever type the elements have. */
template <class Place, class See>
bool see_entries(matio_types type, const void* data, std::size_t count, Place&& place, See&& see)
{
    switch (type)
    {
        case MAT_T_DOUBLE:
            return see_entries<double>(data, count, place, see);
        case MAT_T_SINGLE:
            return see_entries<float>(data, count, place, see);
        case MAT_T_INT8:
        case MAT_T_UINT8:
            return see_entries<std::uint8_t>(data, count, place, see);
        case MAT_T_INT16:
        case MAT_T_UINT16:
            return see_entries<std::uint16_t>(data, count, place, see);
        case MAT_T_INT32:
        case MAT_T_UINT32:
            return see_entries<std::uint32_t>(data, count, place, see);
        case MAT_T_INT64:
        case MAT_T_UINT64:
            return see_entries<std::uint64_t>(data, count, place, see);
        default:
            return false;
    }
}

/** Row and column of element i of a full matrix: MATLAB stores columns one after the other. */
bool see_full(const matvar_t& matrix, Pairs& pairs)
{
    const auto rows = matrix.dims[0];
    return see_entries(
        matrix.data_type,
        matrix.data,
        rows * matrix.dims[1],
        [rows](std::size_t i) { return std::pair(i % rows, i / rows); },
        [&pairs](const auto& pair) { pairs.push_back(pair); });
}

/** Elements of a sparse matrix by columns: jc[c] to jc[c + 1] are those of column c. */
bool see_sparse(const matvar_t& matrix, Pairs& pairs)
{
    const auto& sparse = *static_cast<const mat_sparse_t*>(matrix.data);
    const std::size_t count = sparse.ndata;
    if (sparse.njc != matrix.dims[1] + 1 || sparse.nir < count || sparse.jc[sparse.njc - 1] > count)
        return false;
    std::size_t column = 0;
    return see_entries(
        matrix.data_type,
        sparse.data,
        sparse.jc[sparse.njc - 1],
        [&](std::size_t i)
        {
            while (column + 1 < matrix.dims[1] && i >= sparse.jc[column + 1]) ++column;
            return std::pair(std::size_t{sparse.ir[i]}, column);
        },
        [&pairs](const auto& pair) { pairs.push_back(pair); });
}

/** The entries that are not 0, of a square matrix. Value type. */
struct LoopMatrix
{
    std::size_t size = 0;
    Pairs entries;
};

LoopMatrix read_matrix(const std::string& path)
{
    const auto name = find_matrix(path);
    const auto file = open_mat_file(path);
    const MatVariable matrix{Mat_VarRead(file.get(), name.c_str()), &Mat_VarFree};
    if (!matrix || matrix->data == nullptr)
        throw std::runtime_error("cannot read the matrix " + name + " of " + path +
                                 "; is the file damaged?");
    if (matrix->dims[0] != matrix->dims[1])
        throw std::runtime_error("the matrix " + describe(*matrix) + " of " + path +
                                 " is not square; a loop matrix has a row and a column a frame");
    LoopMatrix read{matrix->dims[0], {}};
    const bool sparse = matrix->class_type == MAT_C_SPARSE;
    if (!(sparse ? see_sparse(*matrix, read.entries) : see_full(*matrix, read.entries)))
        throw std::runtime_error("the matrix " + name + " of " + path +
                                 " is damaged or has a cell that is not a number");
    return read;
}

std::string to_bytes(const LoopMatrix& matrix)
{
    std::vector<std::size_t> numbers{matrix.size};
    numbers.reserve(1 + 2 * matrix.entries.size());
    for (const auto& [row, column] : matrix.entries)
    {
        numbers.push_back(row);
        numbers.push_back(column);
    }
    return {reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(numbers[0])};
}

LoopLabels labels_from_bytes(const std::string& bytes)
{
    std::vector<std::size_t> numbers(bytes.size() / sizeof(std::size_t));
    std::memcpy(numbers.data(), bytes.data(), numbers.size() * sizeof(numbers[0]));
    Pairs pairs;
    for (std::size_t i = 1; i + 1 < numbers.size(); i += 2)
        pairs.emplace_back(numbers[i], numbers[i + 1]);
    return to_loop_labels(std::move(pairs), numbers.at(0));
}
}  // namespace

LoopLabels read_loop_matrix(const std::string& path)
{
    constexpr TrialLimits kLimits{std::size_t{900} << 20U, 20};
    const auto outcome = run_in_trial([&] { return to_bytes(read_matrix(path)); }, kLimits);
    if (!outcome.crash.empty())
        throw std::runtime_error("cannot read " + path + ": matio's attempt ended in " +
                                 outcome.crash +
                                 "; fetch it again, or store the matrix as sparse or uint8");
    if (outcome.error) throw std::runtime_error(*outcome.error);
    return labels_from_bytes(outcome.result);
}

}  // namespace fild
