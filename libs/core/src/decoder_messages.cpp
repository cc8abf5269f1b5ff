// SPDX-License-Identifier: BSD-3-Clause
#include "fild/core/decoder_messages.h"

#include <algorithm>
#include <array>
#include <fcntl.h>
#include <mutex>
#include <string>
#include <string_view>
#include <sys/mman.h>
#include <unistd.h>

namespace fild
{
namespace
{
/** How lines begin that libpng, libjpeg, OpenCV's log and OpenCV's readers of files print. */
constexpr std::array<std::string_view, 15> kBeginnings{"libpng warning: ",
                                                       "libpng error: ",
                                                       "Corrupt JPEG data",
                                                       "Premature end of JPEG",
                                                       "Premature end of input",
                                                       "Invalid SOS parameters",
                                                       "Inconsistent progression sequence",
                                                       "Unknown Adobe color transform",
                                                       "Unsupported marker type",
                                                       "Warning: unknown JFIF revision",
                                                       "Application transferred too ",
                                                       "[ WARN:",
                                                       "[ERROR:",
                                                       "imread",
                                                       "imdecode"};

bool is_of_decoder(std::string_view line)
{
    return std::any_of(kBeginnings.begin(),
                       kBeginnings.end(),
                       [&](std::string_view beginning)
                       { return line.substr(0, beginning.size()) == beginning; });
}

std::string without_decoder_lines(std::string_view text)
{
    std::string kept;
    while (!text.empty())
    {
        const auto length = std::min(text.find('\n'), text.size() - 1) + 1;
        if (!is_of_decoder(text)) kept += text.substr(0, length);
        text.remove_prefix(length);
    }
    return kept;
}

std::string content_of(int file)
{
    std::string content;
    std::array<char, 4096> part{};
    for (;;)
    {
        const auto count =
            ::pread(file, part.data(), part.size(), static_cast<off_t>(content.size()));
        if (count <= 0) return content;
        content.append(part.data(), static_cast<std::size_t>(count));
    }
}

void print(std::string_view text)
{
    while (!text.empty())
    {
        const auto count = ::write(STDERR_FILENO, text.data(), text.size());
        if (count <= 0) return;
        text.remove_prefix(static_cast<std::size_t>(count));
    }
}

/** The process's standard error stream, which leads to a file in memory while anybody asks for
 *  that. Where the system gives no such file nothing is kept. Thread-safe. */
class StandardError
{
 public:
    void divert()
    {
        const std::lock_guard<std::mutex> lock(mutex_);
        if (users_++ > 0) return;
        kept_ = ::memfd_create("messages", MFD_CLOEXEC);
        if (kept_ < 0) return;
        original_ = ::fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
        if (original_ >= 0) ::dup2(kept_, STDERR_FILENO);
    }

    void restore()
    {
        const std::lock_guard<std::mutex> lock(mutex_);
        if (--users_ > 0 || kept_ < 0) return;
        if (original_ >= 0)
        {
            ::dup2(original_, STDERR_FILENO);
            ::close(original_);
            print(without_decoder_lines(content_of(kept_)));
        }
        ::close(kept_);
    }

 private:
    std::mutex mutex_;  ///< guards all below
    int users_ = 0;
    int kept_ = -1;
    int original_ = -1;
};

/** A process has one: threads that decode at once share it. */
StandardError& standard_error()
{
    static StandardError one;
    return one;
}
}  // namespace

WithoutDecoderMessages::WithoutDecoderMessages()
{
    standard_error().divert();
}

WithoutDecoderMessages::~WithoutDecoderMessages()
{
    standard_error().restore();
}

}  // namespace fild
