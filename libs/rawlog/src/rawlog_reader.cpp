// SPDX-License-Identifier: BSD-3-Clause
#include "fild/rawlog/rawlog_reader.h"

#include "entry_process.h"
#include "fild/core/decoder_messages.h"
#include "fild/core/words.h"
#include "gz_archive.h"
#include "mrpt_reason.h"

#include <mrpt/maps/registerAllClasses.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CObservation.h>
#include <mrpt/obs/CRawlog.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/system/os.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <deque>
#include <filesystem>
#include <fstream>
#include <new>
#include <optional>
#include <utility>

namespace fild
{
namespace
{
using mrpt::serialization::CSerializable;

std::string first_bytes(const std::string& path)
{
    std::string bytes(512, '\0');
    std::ifstream file(path, std::ios::binary);
    file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    bytes.resize(static_cast<std::size_t>(file.gcount()));
    return bytes;
}

/** What a file that is no rawlog seems to be, from its first bytes. */
std::string guess_kind(const std::string& bytes)
{
    const std::array<std::pair<const char*, const char*>, 9> kinds{
        {{"\x89PNG", "a PNG image"},
         {"\xFF\xD8\xFF", "a JPEG image"},
         {"PK\x03\x04", "a zip archive"},
         {"#ROSBAG", "a ROS bag"},
         {"SQLite format 3", "an SQLite file (a ROS 2 bag?)"},
         {"\x1F\x8B", "a gzip file of something else"},
         {"BZh", "a bzip2 file"},
         {"\x28\xB5\x2F\xFD", "a zstd file"},
         {"\xFD"
          "7zXZ",
          "an xz file"}}};
    for (const auto& [start, kind] : kinds)
        if (bytes.rfind(start, 0) == 0) return kind;
    const bool is_text = std::all_of(bytes.begin(),
                                     bytes.end(),
                                     [](char c)
                                     {
                                         const auto byte = static_cast<unsigned char>(c);
                                         return byte >= 32 || (byte >= 9 && byte <= 13);
                                     });
    return is_text ? "a text file" : "";
}

bool belongs_in_rawlog(const CSerializable* object)
{
    return dynamic_cast<const mrpt::obs::CObservation*>(object) != nullptr ||
           dynamic_cast<const mrpt::obs::CSensoryFrame*>(object) != nullptr ||
           dynamic_cast<const mrpt::obs::CActionCollection*>(object) != nullptr ||
           dynamic_cast<const mrpt::obs::CRawlog*>(object) != nullptr;
}

/** The class name an MRPT object begins with: one byte of 128 + its length, then the name (before
 *  2006: four bytes of length). Empty when `head` does not begin so. */
std::string class_name_in(const std::string& head)
{
    if (head.size() < 5) return "";
    const auto first = static_cast<unsigned char>(head[0]);
    const bool is_old_format = first < 0x80U && head.compare(1, 3, std::string(3, '\0')) == 0;
    if (first < 0x80U && !is_old_format) return "";
    const auto name = head.substr(is_old_format ? 4 : 1, first & 0x7FU);
    const auto belongs_in_name = [](unsigned char c)
    { return std::isalnum(c) != 0 || c == '_' || c == ':' || c == '<' || c == '>'; };
    return std::all_of(name.begin(), name.end(), belongs_in_name) ? name : "";
}

/** The unpacked first bytes of a plain or gzipped file; fewer when it ends before. */
std::string first_unpacked_bytes(const std::string& path)
{
    const GzHandle file(gzopen(path.c_str(), "rb"));
    std::string bytes(129, '\0');
    const int count =
        file ? gzread(file.get(), bytes.data(), static_cast<unsigned>(bytes.size())) : 0;
    bytes.resize(static_cast<std::size_t>(std::max(0, count)));
    return bytes;
}

/** Nothing when the file begins like a rawlog; else what it is instead, to be said to the user. A
 *  class not known here passes: the reader will name it. */
std::optional<std::string> kind_if_no_rawlog(const std::string& path)
{
    const auto unpacked = first_unpacked_bytes(path);
    if (unpacked.empty()) return std::nullopt;  // damaged gzip data: so will the reader say
    const auto name = class_name_in(unpacked);
    if (name.empty())
    {
        const auto kind = guess_kind(first_bytes(path));
        return kind.empty() ? "" : " but " + kind;
    }
    const auto* known = mrpt::rtti::findRegisteredClass(name);
    if (known == nullptr) return std::nullopt;
    const auto object = std::dynamic_pointer_cast<CSerializable>(known->createObject());
    if (belongs_in_rawlog(object.get())) return std::nullopt;
    return " but a file with a " + name;
}
}  // namespace

struct RawlogReader::State
{
    State(std::string file, std::uint64_t bytes, std::size_t max_entry_bytes)
        : path(std::move(file)), size(bytes), process(path, max_entry_bytes)
    {
    }

    bool read_entry();
    CSerializable::Ptr read_object(EntryBytes& bytes);
    void unpack(const CSerializable::Ptr& object);
    [[noreturn]] void fail_as_damaged(const std::string& reason);
    [[noreturn]] void fail_at_unknown(const std::string& object);
    [[noreturn]] void fail(const std::string& state,
                           const std::string& reason,
                           const std::string& way_out);

    /** Does a step that takes memory for an entry. */
    template <class Step>
    auto with_memory(Step&& step)
    {
        try
        {
            return step();
        }
        catch (const std::bad_alloc&)
        {
            fail_as_damaged(kTooLittleMemory);
        }
    }

    std::string path;
    std::uint64_t size;
    EntryProcess process;
    std::deque<RawlogEntry> pending;
    std::size_t entries = 0;
    bool has_ended = false;
    std::optional<TruncatedRawlog> failure;
};

/** Reads one entry of the file into `pending`; false at the clean end. */
bool RawlogReader::State::read_entry()
{
    if (failure) throw TruncatedRawlog(*failure);
    if (has_ended) return false;
    auto next = with_memory([this] { return process.next(); });
    if (next.kind == EntryMessageKind::failure) fail_as_damaged(next.reason);
    if (next.kind == EntryMessageKind::unknown_object) fail_at_unknown(next.reason);
    has_ended = next.kind == EntryMessageKind::end;
    if (has_ended) return false;
    unpack(with_memory([&] { return read_object(next.bytes); }));
    ++entries;
    return true;
}

CSerializable::Ptr RawlogReader::State::read_object(EntryBytes& bytes)
{
    const WithoutDecoderMessages quiet;
    try
    {
        return bytes.ReadObject();
    }
    catch (const std::bad_alloc&)
    {
        throw;
    }
    catch (const std::exception& error)
    {
        fail_as_damaged(mrpt_reason(error));
    }
}

void RawlogReader::State::unpack(const CSerializable::Ptr& object)
{
    if (auto observation = std::dynamic_pointer_cast<mrpt::obs::CObservation>(object))
        pending.push_back({std::move(observation), nullptr});
    else if (auto actions = std::dynamic_pointer_cast<mrpt::obs::CActionCollection>(object))
        pending.push_back({nullptr, std::move(actions)});
    else if (const auto frame = std::dynamic_pointer_cast<mrpt::obs::CSensoryFrame>(object))
        for (const auto& each : *frame)
            if (each) pending.push_back({each, nullptr});
}

void RawlogReader::State::fail_as_damaged(const std::string& reason)
{
    fail("is cut off or damaged", reason, "copy or record it again, or go on with what was read");
}

void RawlogReader::State::fail_at_unknown(const std::string& object)
{
    fail("cannot be read further",
         mrpt::system::MRPT_getVersion() + " does not know " + object +
             ", which a newer MRPT writes (or the file is damaged)",
         "build mrpt-fild with that MRPT, or remove these observations with its rawlog-edit "
         "--remove-label");
}

void RawlogReader::State::fail(const std::string& state,
                               const std::string& reason,
                               const std::string& way_out)
{
    const auto position = process.stored_bytes_read();
    failure.emplace("rawlog " + path + " " + state + " after " +
                        count_of(entries, "entry", "entries") + ", near byte " +
                        std::to_string(position) + " of " + std::to_string(size) + ": " + reason +
                        "; " + way_out,
                    entries,
                    position);
    throw TruncatedRawlog(*failure);
}

RawlogReader::RawlogReader(const std::string& path, int max_entry_megabytes)
{
    mrpt::maps::registerAllClasses_mrpt_maps();  // CObservationPointCloud and others live there
    namespace fs = std::filesystem;
    std::error_code error;
    if (!fs::exists(path, error))
        throw std::runtime_error("no such rawlog: " + path + "; check the path");
    if (!fs::is_regular_file(path))
        throw std::runtime_error(path + " is no file; name a .rawlog file");
    const auto size = fs::file_size(path);
    const std::string hint = "; name a .rawlog file written by MRPT";
    if (size == 0) throw std::runtime_error("rawlog " + path + " is empty (0 bytes)" + hint);
    const auto kind = kind_if_no_rawlog(path);
    if (kind) throw std::runtime_error(path + " is no rawlog" + *kind + hint);
    const GzReader can_be_read(path);
    state_ =
        std::make_unique<State>(path, size, static_cast<std::size_t>(max_entry_megabytes) << 20U);
}

RawlogReader::~RawlogReader() = default;

RawlogEntry RawlogReader::next_entry()
{
    while (state_->pending.empty())
        if (!state_->read_entry()) return {};
    auto entry = std::move(state_->pending.front());
    state_->pending.pop_front();
    return entry;
}

mrpt::obs::CObservation::Ptr RawlogReader::next()
{
    auto entry = next_entry();
    while (entry.actions) entry = next_entry();
    return entry.observation;
}

double RawlogReader::fraction_read() const
{
    const auto share = static_cast<double>(state_->process.stored_bytes_read()) /
                       static_cast<double>(state_->size);
    return std::min(1.0, share);
}

}  // namespace fild
