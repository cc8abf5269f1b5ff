// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace fild
{
/** Keeps from the standard error stream, while at least one exists, the lines that image decoders
 *  (libpng, libjpeg, OpenCV) print there of damaged images: they name neither file nor frame. All
 *  other lines that the process prints meanwhile appear when the last one has gone. Thread-safe. */
class WithoutDecoderMessages
{
 public:
    WithoutDecoderMessages();
    WithoutDecoderMessages(const WithoutDecoderMessages&) = delete;
    WithoutDecoderMessages& operator=(const WithoutDecoderMessages&) = delete;
    ~WithoutDecoderMessages();
};

}  // namespace fild
