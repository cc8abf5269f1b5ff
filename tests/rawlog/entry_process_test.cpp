// SPDX-License-Identifier: BSD-3-Clause
#include "entry_process.h"

#include "drawn_rawlog.h"
#include "held_lock.h"

#include <gmock/gmock.h>
#include <mrpt/obs/CObservation.h>
#include <mrpt/rtti/CObject.h>
#include <mrpt/serialization/CArchive.h>

#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <fstream>
#include <functional>
#include <mutex>
#include <string>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

namespace fild::testing
{
const auto kTestProcess = ::getpid();

/** Reading it in a fork of the test runs a function, which may wait for a lock as a library's code
 *  may. */
class WaitingObservation : public mrpt::obs::CObservation
{
    DEFINE_SERIALIZABLE(WaitingObservation, fild::testing)

 public:
    static std::function<void()>& on_reading()
    {
        static std::function<void()> of_all;
        return of_all;
    }

    void getSensorPose(mrpt::poses::CPose3D&) const override {}
    void setSensorPose(const mrpt::poses::CPose3D&) override {}
};
IMPLEMENTS_SERIALIZABLE(WaitingObservation, CObservation, fild::testing)

std::uint8_t WaitingObservation::serializeGetVersion() const
{
    return 0;
}

void WaitingObservation::serializeTo(mrpt::serialization::CArchive& out) const
{
    out << sensorLabel;
}

void WaitingObservation::serializeFrom(mrpt::serialization::CArchive& in, std::uint8_t)
{
    if (::getpid() != kTestProcess) on_reading()();
    in >> sensorLabel;
}
}  // namespace fild::testing

namespace
{
using namespace fild::testing;
using ::testing::ElementsAre;
using namespace std::chrono_literals;

constexpr std::size_t kMaxEntryBytes = std::size_t{16} << 20U;
constexpr int kIdleSeconds = 1;

mrpt::obs::CObservation::Ptr waiting_observation(const std::string& label)
{
    auto observation = std::make_shared<WaitingObservation>();
    observation->sensorLabel = label;
    return observation;
}

/** Waits as for a lock that another thread holds. */
void wait_for_lock(std::chrono::milliseconds time)
{
    std::mutex mutex;
    std::unique_lock lock(mutex);
    std::condition_variable never;
    never.wait_for(lock, time);
}

class EntryProcess : public ::testing::Test
{
 protected:
    EntryProcess()
    {
        mrpt::rtti::registerClass(CLASS_ID(WaitingObservation));
        write_plain(rawlog(), {waiting_observation("FIRST"), waiting_observation("SECOND")});
    }

    std::string rawlog() const { return folder_.path("waits.rawlog"); }

    /** How often something was read, this time included, by all processes. */
    std::uintmax_t count_reading() const
    {
        std::ofstream(folder_.path("readings"), std::ios::app) << 'x';
        return std::filesystem::file_size(folder_.path("readings"));
    }

    static std::vector<std::string> labels_of(fild::EntryProcess& process)
    {
        std::vector<std::string> labels;
        for (auto next = process.next(); next.kind == fild::EntryMessageKind::entry;
             next = process.next())
            labels.push_back(next.bytes.ReadObject<WaitingObservation>()->sensorLabel);
        return labels;
    }

 private:
    TemporaryFolder folder_;
};

TEST_F(EntryProcess, IsBegunAnewAtTheSameEntryWhenItWaitsForALockOfAnotherThread)
{
    std::mutex mutex;
    const fild::testing::HeldLock other(mutex, std::chrono::milliseconds(500));
    WaitingObservation::on_reading() = [&]
    {
        if (count_reading() > 1) const std::lock_guard lock(mutex);
    };
    fild::EntryProcess process(rawlog(), kMaxEntryBytes, kIdleSeconds);
    const auto labels = labels_of(process);
    EXPECT_THAT(labels, ElementsAre("FIRST", "SECOND"));
}

TEST_F(EntryProcess, GivesNoEntryTwiceWhenTheNextProcessIsHeldUp)
{
    WaitingObservation::on_reading() = [&]
    {
        const auto reading = count_reading();
        if (reading == 2) wait_for_lock(1min);
        if (reading == 3) wait_for_lock(2500ms);
    };
    fild::EntryProcess process(rawlog(), kMaxEntryBytes, kIdleSeconds);
    EXPECT_THAT(labels_of(process), ElementsAre("FIRST", "SECOND"));
}

TEST_F(EntryProcess, WaitsForNoOtherChildWhenTheFileIsGone)
{
    const auto other = ::fork();
    if (other == 0) ::_exit(7);
    WaitingObservation::on_reading() = [&]
    {
        if (count_reading() < 2) return;
        std::filesystem::remove(rawlog());
        wait_for_lock(1min);
    };
    fild::EntryProcess process(rawlog(), kMaxEntryBytes, kIdleSeconds);
    EXPECT_THAT(labels_of(process), ElementsAre("FIRST"));
    int status = 0;
    EXPECT_EQ(::waitpid(other, &status, 0), other);
    EXPECT_EQ(WEXITSTATUS(status), 7);
}

TEST_F(EntryProcess, IsGoneWithTheLastEntry)
{
    WaitingObservation::on_reading() = [] {};
    fild::EntryProcess process(rawlog(), kMaxEntryBytes);
    EXPECT_THAT(labels_of(process), ElementsAre("FIRST", "SECOND"));
    EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1);  // no child is left
    EXPECT_EQ(process.next().kind, fild::EntryMessageKind::failure);
}

}  // namespace
