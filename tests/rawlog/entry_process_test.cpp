// SPDX-License-Identifier: BSD-3-Clause
#include "drawn_rawlog.h"
#include "fild/rawlog/rawlog_reader.h"

#include <gmock/gmock.h>
#include <mrpt/obs/CObservation.h>
#include <mrpt/rtti/CObject.h>
#include <mrpt/serialization/CArchive.h>

#include <chrono>
#include <future>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace fild::testing
{
/** Reading it takes a lock, as a library may do that the program uses in another thread. */
class LockingObservation : public mrpt::obs::CObservation
{
    DEFINE_SERIALIZABLE(LockingObservation, fild::testing)

 public:
    static std::mutex& mutex()
    {
        static std::mutex of_all;
        return of_all;
    }

    void getSensorPose(mrpt::poses::CPose3D&) const override {}
    void setSensorPose(const mrpt::poses::CPose3D&) override {}
};
IMPLEMENTS_SERIALIZABLE(LockingObservation, CObservation, fild::testing)

std::uint8_t LockingObservation::serializeGetVersion() const
{
    return 0;
}

void LockingObservation::serializeTo(mrpt::serialization::CArchive& out) const
{
    out << sensorLabel;
}

void LockingObservation::serializeFrom(mrpt::serialization::CArchive& in, std::uint8_t)
{
    const std::lock_guard lock(mutex());
    in >> sensorLabel;
}
}  // namespace fild::testing

namespace
{
using namespace fild::testing;

mrpt::obs::CObservation::Ptr locking_observation(const std::string& label)
{
    auto observation = std::make_shared<LockingObservation>();
    observation->sensorLabel = label;
    return observation;
}

TEST(EntryProcess, IsBegunAnewAtTheSameEntryWhenItWaitsForALockOfAnotherThread)
{
    mrpt::rtti::registerClass(CLASS_ID(LockingObservation));
    const TemporaryFolder folder;
    write_plain(folder.path("locks.rawlog"),
                {image_observation(draw_image(), 1, "FIRST"),
                 locking_observation("SECOND"),
                 locking_observation("THIRD")});
    std::promise<void> is_locked;
    std::thread other(
        [&]
        {
            const std::lock_guard lock(LockingObservation::mutex());
            is_locked.set_value();
            std::this_thread::sleep_for(std::chrono::seconds(1));
        });
    is_locked.get_future().wait();

    fild::RawlogReader reader(folder.path("locks.rawlog"));
    std::vector<std::string> labels;
    while (const auto observation = reader.next()) labels.push_back(observation->sensorLabel);
    other.join();
    EXPECT_THAT(labels, ::testing::ElementsAre("FIRST", "SECOND", "THIRD"));
}

}  // namespace
