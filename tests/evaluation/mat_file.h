// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <matio.h>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace fild::testing
{
using Cells = std::vector<std::pair<std::size_t, std::size_t>>;

/** A MATLAB file of version 5 under construction. */
class MatFile
{
 public:
    explicit MatFile(const std::string& path)
        : file_(Mat_CreateVer(path.c_str(), nullptr, MAT_FT_MAT5))
    {
        if (file_ == nullptr) throw std::runtime_error("cannot write " + path);
    }
    MatFile(const MatFile&) = delete;
    MatFile& operator=(const MatFile&) = delete;
    ~MatFile() { Mat_Close(file_); }

    /** A full matrix that is `value` in the cells (row, column) and 0 elsewhere. */
    template <class Element>
    void full(const std::string& name,
              matio_classes type,
              matio_types element,
              std::size_t rows,
              std::size_t columns,
              const Cells& cells,
              Element value = 1,
              int flags = 0)
    {
        std::vector<Element> data(rows * columns);
        for (const auto& [row, column] : cells) data[column * rows + row] = value;
        std::size_t dims[2] = {rows, columns};
        write(Mat_VarCreate(name.c_str(), type, element, 2, dims, data.data(), flags));
    }

    /** A sparse n x n matrix of doubles, or logical, that is 1 in the cells. */
    void sparse(const std::string& name, std::size_t n, const Cells& cells, bool logical)
    {
        std::map<std::size_t, std::vector<mat_uint32_t>> rows_of_column;
        for (const auto& [row, column] : cells)
            rows_of_column[column].push_back(static_cast<mat_uint32_t>(row));
        std::vector<mat_uint32_t> ir;
        std::vector<mat_uint32_t> jc{0};
        for (std::size_t column = 0; column < n; ++column)
        {
            for (const auto row : rows_of_column[column]) ir.push_back(row);
            jc.push_back(static_cast<mat_uint32_t>(ir.size()));
        }
        std::vector<double> ones(ir.size(), 1.0);
        std::vector<std::uint8_t> bytes(ir.size(), 1);
        mat_sparse_t sparse{};
        sparse.nzmax = static_cast<mat_uint32_t>(ir.size());
        sparse.nir = sparse.nzmax;
        sparse.ndata = sparse.nzmax;
        sparse.njc = static_cast<mat_uint32_t>(jc.size());
        sparse.ir = ir.data();
        sparse.jc = jc.data();
        sparse.data = logical ? static_cast<void*>(bytes.data()) : ones.data();
        std::size_t dims[2] = {n, n};
        write(Mat_VarCreate(name.c_str(),
                            MAT_C_SPARSE,
                            logical ? MAT_T_UINT8 : MAT_T_DOUBLE,
                            2,
                            dims,
                            &sparse,
                            MAT_F_DONT_COPY_DATA | (logical ? MAT_F_LOGICAL : 0)));
    }

    void text(const std::string& name, std::string value)
    {
        std::size_t dims[2] = {1, value.size()};
        write(Mat_VarCreate(name.c_str(), MAT_C_CHAR, MAT_T_UINT8, 2, dims, value.data(), 0));
    }

 private:
    void write(matvar_t* variable)
    {
        if (variable == nullptr || Mat_VarWrite(file_, variable, MAT_COMPRESSION_NONE) != 0)
            throw std::runtime_error("cannot write a variable");
        Mat_VarFree(variable);
    }

    mat_t* file_;
};

}  // namespace fild::testing
