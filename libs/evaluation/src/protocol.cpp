// SPDX-License-Identifier: BSD-3-Clause
#include "fild/evaluation/protocol.h"

#include "fild/core/parse_number.h"

#include <locale>
#include <optional>
#include <sstream>
#include <stdexcept>

namespace fild
{
namespace
{
constexpr const char* kDoubtful =
    "; neither right nor wrong when it is a pair labelled as doubtful";
}

Protocol parse_protocol(const std::string& word)
{
    Protocol protocol;
    if (word == "exact") return protocol;
    const auto colon = word.find(':');
    const auto name = word.substr(0, colon);
    const auto argument = colon == std::string::npos ? "" : word.substr(colon + 1);
    if (const auto window = parse_number<std::size_t>(argument);
        name == "window" && window && *window > 0)
    {
        protocol.kind = Protocol::Kind::window;
        protocol.window = *window;
        return protocol;
    }
    const auto comma = argument.find(',');
    const bool has_doubtful = comma != std::string::npos;
    const auto radius = parse_number<double>(argument.substr(0, comma));
    const auto doubtful =
        has_doubtful ? parse_number<double>(argument.substr(comma + 1)) : std::optional(0.0);
    if (name == "radius" && radius && doubtful && *radius > 0 &&
        (!has_doubtful || *doubtful > *radius))
    {
        protocol.kind = Protocol::Kind::radius;
        protocol.radius = *radius;
        protocol.doubtful_radius = *doubtful;
        return protocol;
    }
    throw std::invalid_argument("'" + word +
                                "' is no protocol; it is exact, window:N (frames, at least 1), "
                                "radius:R (metres, above 0) or radius:R,D (pairs up to D metres "
                                "are neither right nor wrong)");
}

std::string to_word(const Protocol& protocol)
{
    std::ostringstream word;
    word.imbue(std::locale::classic());
    switch (protocol.kind)
    {
        case Protocol::Kind::exact:
            word << "exact";
            break;
        case Protocol::Kind::window:
            word << "window:" << protocol.window;
            break;
        case Protocol::Kind::radius:
            word << "radius:" << protocol.radius;
            if (protocol.doubtful_radius > 0) word << ',' << protocol.doubtful_radius;
            break;
    }
    return word.str();
}

std::string rule_of(const Protocol& protocol)
{
    std::ostringstream rule;
    rule.imbue(std::locale::classic());
    rule << "a loop closure is right when ";
    switch (protocol.kind)
    {
        case Protocol::Kind::exact:
            rule << "its query and candidate are a labelled pair" << kDoubtful;
            break;
        case Protocol::Kind::window:
            rule << "its candidate is at most " << protocol.window
                 << " frames from one that is labelled for its query" << kDoubtful;
            break;
        case Protocol::Kind::radius:
            rule << "its poses are at most " << protocol.radius << " m and "
                 << protocol.max_angle_deg << " degrees apart and its candidate is at least "
                 << protocol.min_age_seconds
                 << " s older than its query; neither right nor wrong when the candidate is "
                    "younger, or a pose is unknown";
            if (protocol.doubtful_radius > 0)
                rule << ", or the poses are at most " << protocol.doubtful_radius << " m and "
                     << 2 * protocol.max_angle_deg << " degrees apart";
            break;
    }
    return rule.str();
}

}  // namespace fild
