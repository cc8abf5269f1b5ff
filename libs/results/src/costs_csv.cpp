// SPDX-License-Identifier: BSD-3-Clause
#include "fild/results/costs_csv.h"

#include "fild/core/spread.h"
#include "shared_columns.h"

namespace fild
{
namespace
{
std::size_t count_rows(const std::string& path)
{
    std::size_t count = 0;
    for (CsvReader reader(path); reader.next();) ++count;
    return count;
}
}  // namespace

CsvColumns<CostRow> costs_csv_columns()
{
    CsvColumns<CostRow> columns;
    columns.push_back(frame_column<CostRow>([](auto& row) -> auto& { return row.frame; }));
    for (std::size_t i = 0; i < kFrameStages.size(); ++i)
        columns.push_back({std::string(kFrameStages.at(i)) + "_ms",
                           [i](const CostRow& row) { return decimal(row.stage_ms.at(i), 3); },
                           [i](const CsvField& field, CostRow& row)
                           { row.stage_ms.at(i) = field.number<double>(); },
                           false});
    columns.push_back({"map_bytes",
                       [](const CostRow& row) { return std::to_string(row.map_bytes); },
                       [](const CsvField& field, CostRow& row)
                       { row.map_bytes = field.number<std::size_t>(); },
                       false});
    columns.push_back({"resident_bytes",
                       [](const CostRow& row)
                       { return row.resident_bytes ? std::to_string(*row.resident_bytes) : ""; },
                       [](const CsvField& field, CostRow& row)
                       {
                           if (!field.empty()) row.resident_bytes = field.number<std::size_t>();
                       },
                       false});
    return columns;
}

std::vector<CostRow> read_costs_csv(const std::string& path, std::size_t max_rows)
{
    const auto wanted = spread_indices(max_rows, count_rows(path));
    auto next = wanted.begin();
    std::size_t number = 0;
    std::vector<CostRow> rows;
    read_csv(path,
             costs_csv_columns(),
             [&](const CostRow& row, const CsvReader&)
             {
                 if (next == wanted.end() || *next != number++) return;
                 ++next;
                 rows.push_back(row);
             });
    return rows;
}

}  // namespace fild
