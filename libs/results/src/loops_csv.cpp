// SPDX-License-Identifier: BSD-3-Clause
#include "fild/results/loops_csv.h"

#include "fild/core/angle.h"
#include "shared_columns.h"

#include <utility>

namespace fild
{
namespace
{
using Part = std::optional<LoopRow::Three> LoopRow::*;

/** Three columns, which are filled all or none.
 *  \param unit  of the column, in the row's own unit. */
void append_three(CsvColumns<LoopRow>& columns,
                  const std::array<const char*, 3>& names,
                  Part part,
                  double unit)
{
    for (std::size_t i = 0; i < names.size(); ++i)
        columns.push_back({names.at(i),
                           [=](const LoopRow& row)
                           { return row.*part ? decimal6((*(row.*part)).at(i) / unit) : ""; },
                           [=](const CsvField& field, LoopRow& row)
                           {
                               auto& three = row.*part;
                               if (i > 0 && field.empty() == three.has_value())
                                   field.fail("empty, while a field beside it is not");
                               if (field.empty()) return;
                               if (!three) three.emplace();
                               three->at(i) = field.number<double>() * unit;
                           },
                           false});
}
}  // namespace

CsvColumns<LoopRow> loops_csv_columns()
{
    CsvColumns<LoopRow> columns;
    append_columns(columns, frames_csv_columns());
    append_three(columns, {"x", "y", "z"}, &LoopRow::position, 1);
    append_three(
        columns, {"yaw_deg", "pitch_deg", "roll_deg"}, &LoopRow::angles, kRadiansPerDegree);
    append_three(columns, {"sigma_x", "sigma_y", "sigma_z"}, &LoopRow::position_deviations, 1);
    append_three(columns,
                 {"sigma_yaw_deg", "sigma_pitch_deg", "sigma_roll_deg"},
                 &LoopRow::angle_deviations,
                 kRadiansPerDegree);
    columns.push_back({"weight",
                       [](const LoopRow& row) { return row.weight ? decimal6(*row.weight) : ""; },
                       [](const CsvField& field, LoopRow& row)
                       {
                           if (!field.empty()) row.weight = field.number<double>();
                       },
                       false});
    columns.push_back({"edge",
                       [](const LoopRow& row) { return row.edge; },
                       [](const CsvField& field, LoopRow& row) { row.edge = field.text(); },
                       false});
    append_three(columns, {"direction_x", "direction_y", "direction_z"}, &LoopRow::direction, 1);
    return columns;
}

std::vector<LoopRow> read_loops_csv(const std::string& path)
{
    std::vector<LoopRow> rows;
    read_csv(path,
             loops_csv_columns(),
             [&](LoopRow row, const CsvReader&) { rows.push_back(std::move(row)); });
    return rows;
}

}  // namespace fild
