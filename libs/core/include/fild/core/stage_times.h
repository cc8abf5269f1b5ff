// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <map>
#include <new>
#include <string>
#include <vector>

namespace fild
{
/** How long each stage took, call by call, in milliseconds of wall time. Not thread-safe: one
 * caller at a time. */
class StageTimes
{
 public:
    struct Statistics
    {
        std::size_t calls = 0;
        double mean_ms = 0;
        double median_ms = 0;
        double p95_ms = 0;  ///< 95 % of the calls took no longer (nearest rank)
        double max_ms = 0;
        double total_ms = 0;
    };

    void add(const std::string& stage, double milliseconds);

    /** Adds all calls of `other`. */
    void merge(const StageTimes& other);

    /** All calls of a stage together, milliseconds; 0 for a stage without calls. Cheap. */
    double total_ms(const std::string& stage) const;

    /** By stage name, alphabetically. Costs a sort of all calls. */
    std::map<std::string, Statistics> statistics() const;

 private:
    struct Calls
    {
        std::vector<float> milliseconds;
        double total_ms = 0;
    };
    std::map<std::string, Calls> calls_;
};

/** Times the scope it lives in as one call of a stage. */
class StageTimer
{
 public:
    StageTimer(StageTimes& times, const char* stage)
        : times_(times), stage_(stage), start_(std::chrono::steady_clock::now())
    {
    }
    StageTimer(const StageTimer&) = delete;
    StageTimer& operator=(const StageTimer&) = delete;
    ~StageTimer()
    {
        const auto elapsed = std::chrono::steady_clock::now() - start_;
        try
        {
            times_.add(stage_, std::chrono::duration<double, std::milli>(elapsed).count());
        }
        catch (const std::bad_alloc&)
        {
            // One call is not counted; a destructor must not throw.
        }
    }

 private:
    StageTimes& times_;
    const char* stage_;
    std::chrono::steady_clock::time_point start_;
};

}  // namespace fild
