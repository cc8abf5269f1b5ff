// SPDX-License-Identifier: BSD-3-Clause
#include "match_caption.h"

#include "picture_text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <limits>
#include <stdexcept>

namespace fild
{
namespace
{
template <class... Values>
std::string formatted(const char* format, Values... values)
{
    std::array<char, 200> text{};
    std::snprintf(text.data(), text.size(), format, values...);
    return text.data();
}

/** The date, or the seconds of a recording that counts from its beginning. */
std::string time_text(double timestamp)
{
    constexpr double kFirstDate = 1e8;  // 1973
    if (!(timestamp > kFirstDate)) return formatted("%.2f s", timestamp);
    const double whole = std::floor(timestamp);
    const auto seconds = static_cast<std::time_t>(whole);
    std::tm date{};
    if (gmtime_r(&seconds, &date) == nullptr) return formatted("%.2f s", timestamp);
    std::array<char, 40> text{};
    std::strftime(text.data(), text.size(), "%Y-%m-%d %H:%M:%S", &date);
    const int hundredths = static_cast<int>((timestamp - whole) * 100);
    return text.data() + formatted(".%02d UTC", hundredths);
}

std::vector<std::string> title(const char* role, FrameId frame, double timestamp)
{
    return {role + formatted(": frame %llu", static_cast<unsigned long long>(to_index(frame))),
            time_text(timestamp)};
}

/** Neither is rounded over the other. */
std::string support_text(double support, double threshold)
{
    const bool is_below = support < threshold;
    const double shown = is_below ? std::floor(1000 * support) / 1000 : support;
    return formatted("support %.3f, %s %.4g", shown, is_below ? "below" : "needed", threshold);
}

double squared_distance(const PixelPair& a, const PixelPair& b)
{
    const auto squared = [](float d) { return static_cast<double>(d) * static_cast<double>(d); };
    return squared(a.query.x - b.query.x) + squared(a.query.y - b.query.y) +
           squared(a.candidate.x - b.candidate.x) + squared(a.candidate.y - b.candidate.y);
}
}  // namespace

void check_match_picture(const MatchPicture& picture)
{
    if (picture.query_image.empty() || picture.candidate_image.empty())
        throw std::invalid_argument("a match picture of an empty image");
    if (!picture.verdict.candidate)
        throw std::invalid_argument("a match picture whose verdict names no candidate");
}

std::vector<std::string> query_title(const MatchPicture& picture)
{
    return title("query", picture.verdict.frame, picture.verdict.timestamp);
}

std::vector<std::string> candidate_title(const MatchPicture& picture)
{
    return title("candidate", picture.verdict.candidate->frame, picture.candidate_timestamp);
}

std::vector<std::string> match_caption(const MatchPicture& picture, std::size_t lines)
{
    const auto& verdict = picture.verdict;
    const double seconds = verdict.timestamp - picture.candidate_timestamp;
    std::vector<std::string> parts{
        verdict.accepted() ? "loop closure" : "no loop closure: " + to_word(verdict.rejection),
        formatted("%.1f s %s", std::abs(seconds), seconds < 0 ? "before, by the clock" : "later"),
        formatted("similarity %.3f", verdict.candidate->similarity),
        formatted("%zu inliers of %zu matches", verdict.inliers, verdict.matches),
        support_text(verdict.support, picture.support_threshold)};
    if (lines < picture.inliers.size())
        parts.push_back(formatted("%zu of %zu lines drawn", lines, picture.inliers.size()));
    if (!picture.rejected.empty()) parts.emplace_back("grey: not inliers");
    return parts;
}

double caption_height(int picture_width)
{
    return std::clamp(picture_width / 100.0, 9.0, 40.0);
}

std::vector<std::string> wrapped(const std::vector<std::string>& parts,
                                 double letter_height,
                                 int width)
{
    const TextStyle style{letter_height};
    const int room = width - cvRound(2 * letter_height);
    std::vector<std::string> lines;
    for (const auto& part : parts)
    {
        const auto longer = lines.empty() ? part : lines.back() + "   |   " + part;
        if (lines.empty() || text_size(longer, style).width > room)
            lines.push_back(part);
        else
            lines.back() = longer;
    }
    return lines;
}

int strip_height(std::size_t lines, double letter_height)
{
    return cvRound((1.8 * static_cast<double>(lines) + 0.9) * letter_height);
}

void draw_strip(cv::Mat& picture,
                const cv::Rect& strip,
                const std::vector<std::string>& lines,
                double letter_height)
{
    constexpr double kSeenThrough = 0.25;  // of lines that cross the strip
    cv::Mat band = picture(strip);
    band.convertTo(band, -1, kSeenThrough, 255 * (1 - kSeenThrough));
    double y = strip.y + 0.85 * letter_height;
    for (const auto& line : lines)
    {
        const cv::Scalar ink(50, 45, 40);
        draw_text(picture, line, {strip.x + letter_height, y}, {letter_height, ink, {0, 0}});
        y += 1.8 * letter_height;
    }
}

std::vector<std::size_t> spread_pairs(const std::vector<PixelPair>& pairs, std::size_t count)
{
    std::vector<std::size_t> chosen;
    std::vector<double> distance(pairs.size(), std::numeric_limits<double>::infinity());
    std::size_t next = 0;
    while (chosen.size() < std::min(count, pairs.size()))
    {
        chosen.push_back(next);
        distance[next] = -1;
        for (std::size_t i = 0; i < pairs.size(); ++i)
            distance[i] = std::min(distance[i], squared_distance(pairs[i], pairs[chosen.back()]));
        next = static_cast<std::size_t>(std::max_element(distance.begin(), distance.end()) -
                                        distance.begin());
    }
    return chosen;
}

}  // namespace fild
