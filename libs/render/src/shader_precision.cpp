// SPDX-License-Identifier: BSD-3-Clause
#include "shader_precision.h"

#include <GL/gl.h>
#include <GL/osmesa.h>
#include <dlfcn.h>
#include <stdexcept>
#include <string>
#include <vector>

namespace fild
{
namespace
{
using ShaderSource = void (*)(GLuint, GLsizei, const char* const*, const GLint*);

ShaderSource shader_source_of_osmesa()
{
    return reinterpret_cast<ShaderSource>(OSMesaGetProcAddress("glShaderSource"));
}

/** The function that would be called if this file did not define one of the same name. */
ShaderSource shader_source_of_others()
{
    return reinterpret_cast<ShaderSource>(::dlsym(RTLD_NEXT, "glShaderSource"));
}

std::string with_high_precision(std::string source)
{
    const std::string medium = "mediump";
    for (auto at = source.find(medium); at != std::string::npos; at = source.find(medium, at))
        source.replace(at, medium.size(), "highp");
    return source;
}
}  // namespace

void require_precise_shaders()
{
    if (shader_source_of_osmesa() == nullptr)
        throw std::runtime_error("cannot draw off-screen: libOSMesa has no glShaderSource");
}

}  // namespace fild

/** Called by MRPT: the linker finds the function of the executable before any library's.
 *  Shaders are ours only where an OSMesa context is current. Those of a program that draws with
 *  OpenGL itself go unchanged to the function that would have received them without this one. */
extern "C" __attribute__((visibility("default"))) void glShaderSource(GLuint shader,
                                                                      GLsizei count,
                                                                      const char* const* strings,
                                                                      const GLint* lengths)
{
    const auto others = fild::shader_source_of_others();
    if (OSMesaGetCurrentContext() == nullptr && others != nullptr)
    {
        others(shader, count, strings, lengths);
        return;
    }
    std::string source;
    for (GLsizei i = 0; i < count; ++i)
    {
        const bool terminated = lengths == nullptr || lengths[i] < 0;
        source += terminated ? std::string(strings[i])
                             : std::string(strings[i], static_cast<std::size_t>(lengths[i]));
    }
    const auto precise = fild::with_high_precision(std::move(source));
    const char* const text = precise.c_str();
    fild::shader_source_of_osmesa()(shader, 1, &text, nullptr);
}
