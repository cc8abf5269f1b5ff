// SPDX-License-Identifier: BSD-3-Clause
#include "fild/matching/hashing_options.h"

namespace fild
{
void THashingOptions::describe(OptionVisitor& visitor)
{
    visitor.flag("rooted", rooted);
    visitor.integer("bits", bits, 32, 1024);
    visitor.choice<CodeSearch>("search",
                               search,
                               {{"cascade", CodeSearch::cascade},
                                {"exhaustive", CodeSearch::exhaustive},
                                {"guided", CodeSearch::guided}});
    visitor.integer("tables", tables, 1, 64);
    visitor.integer("bucket_bits", bucket_bits, 1, 16);
    visitor.real("ratio", ratio, 0.01, 1);
    visitor.flag("mutual_check", mutual_check);
}

void THashingOptions::check_between_fields() const
{
    if (bits % 32 != 0)
        throw std::invalid_argument("bits=" + std::to_string(bits) + " is not a multiple of 32");
}

}  // namespace fild
