// SPDX-License-Identifier: BSD-3-Clause
#include "fild/core/decoder_messages.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <iostream>
#include <thread>
#include <vector>

namespace
{
using fild::WithoutDecoderMessages;
using testing::internal::CaptureStderr;
using testing::internal::GetCapturedStderr;

TEST(WithoutDecoderMessages, KeepsOnlyTheLinesOfDecoders)
{
    CaptureStderr();
    {
        const WithoutDecoderMessages quiet;
        std::fputs("libpng warning: iCCP: too short\n", stderr);
        std::fputs("of another thread\n", stderr);
        std::cerr << "imread_('a.png'): can't read data: unknown\nwithout an end" << std::flush;
    }
    std::fputs("; libpng warning: printed later\n", stderr);
    EXPECT_EQ(GetCapturedStderr(),
              "of another thread\nwithout an end; libpng warning: printed later\n");
}

TEST(WithoutDecoderMessages, MayNestAndRunInSeveralThreads)
{
    CaptureStderr();
    {
        const WithoutDecoderMessages outer;
        std::vector<std::thread> threads;
        for (int i = 0; i < 4; ++i)
            threads.emplace_back(
                []
                {
                    for (int n = 0; n < 50; ++n)
                    {
                        const WithoutDecoderMessages inner;
                        std::fputs("Corrupt JPEG data: bad Huffman code\n", stderr);
                    }
                });
        for (auto& thread : threads) thread.join();
        std::fputs("kept\n", stderr);
    }
    std::fputs("printed\n", stderr);
    EXPECT_EQ(GetCapturedStderr(), "kept\nprinted\n");
}

}  // namespace
