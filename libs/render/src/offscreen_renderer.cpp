// SPDX-License-Identifier: BSD-3-Clause
#include "fild/render/offscreen_renderer.h"

#include "shader_precision.h"

#include <mrpt/opengl/CFBORender.h>
#include <mrpt/opengl/COpenGLScene.h>
#include <mrpt/poses/CPose3D.h>
#include <opencv2/imgproc.hpp>

#include <GL/gl.h>
#include <GL/osmesa.h>
#include <array>
#include <dlfcn.h>
#include <map>
#include <stdexcept>
#include <utility>

// Of OpenGL 3.0; <GL/gl.h> declares 1.3 only.
extern "C" void glGenerateMipmap(GLenum target);

namespace fild
{
namespace
{
constexpr int kSamplesPerSide = 2;

/** MRPT 2.5 builds no mipmaps, without which distant textures flicker. It binds every texture to a
 *  unit of its own for good, so the units lead to all textures of the scene. Not anisotropic: where
 *  a pixel's footprint degenerates, which happens now and then, Mesa 22.3 then computes it for two
 *  minutes. */
void filter_textures_by_mipmaps()
{
    GLint units = 0;
    glGetIntegerv(GL_MAX_COMBINED_TEXTURE_IMAGE_UNITS, &units);
    for (GLint unit = 0; unit < units; ++unit)
    {
        glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
        GLint texture = 0;
        glGetIntegerv(GL_TEXTURE_BINDING_2D, &texture);
        if (texture == 0) continue;
        glGenerateMipmap(GL_TEXTURE_2D);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    }
}

/** Null when there is none. */
OSMesaContext new_context(OSMesaContext sharing)
{
    constexpr std::array<int, 11> kAttributes{OSMESA_FORMAT,
                                              OSMESA_RGBA,
                                              OSMESA_PROFILE,
                                              OSMESA_COMPAT_PROFILE,
                                              OSMESA_CONTEXT_MAJOR_VERSION,
                                              3,
                                              OSMESA_CONTEXT_MINOR_VERSION,
                                              1,
                                              OSMESA_DEPTH_BITS,
                                              24,
                                              0};
    return OSMesaCreateContextAttribs(kAttributes.data(), sharing);
}

void check_camera(const CameraModel& camera)
{
    if (camera.lens != LensModel::none)
        throw std::invalid_argument("an off-screen view has no lens distortion");
    if (camera.width < 1 || camera.height < 1 || !(camera.fx > 0) || !(camera.fy > 0))
        throw std::invalid_argument("an off-screen view needs a size and a focal length");
}

/** The camera for `kSamplesPerSide` times the pixels. OpenGL counts from the corner of the first
 *  pixel, OpenCV from its centre. */
mrpt::img::TCamera sampling_camera(const CameraModel& camera)
{
    mrpt::img::TCamera samples;
    samples.ncols = static_cast<std::uint32_t>(camera.width * kSamplesPerSide);
    samples.nrows = static_cast<std::uint32_t>(camera.height * kSamplesPerSide);
    samples.setIntrinsicParamsFromValues(camera.fx * kSamplesPerSide,
                                         camera.fy * kSamplesPerSide,
                                         (camera.cx + 0.5) * kSamplesPerSide,
                                         (camera.cy + 0.5) * kSamplesPerSide);
    return samples;
}

using PixelSamples = std::array<float, 4>;
static_assert(PixelSamples{}.size() == std::size_t{kSamplesPerSide} * kSamplesPerSide);

/** Depth of a pixel out of its samples: at the edge of an object that of the object, not a mean
 *  with what is behind it. */
float pixel_depth(const PixelSamples& samples)
{
    float nearest = 0;
    for (const float depth : samples)
        if (depth > 0 && (nearest == 0 || depth < nearest)) nearest = depth;
    if (nearest == 0) return 0;
    constexpr float kSameSurface = 1.05F;
    float sum_of_inverses = 0;
    int count = 0;
    for (const float depth : samples)
        if (depth > 0 && depth < nearest * kSameSurface)
        {
            sum_of_inverses += 1 / depth;
            ++count;
        }
    // On a plane it is the inverse of the depth that is linear in the image.
    return static_cast<float>(count) / sum_of_inverses;
}

cv::Mat averaged(const mrpt::img::CImage& samples, const CameraModel& camera)
{
    cv::Mat image;
    cv::resize(samples.asCvMatRef(), image, {camera.width, camera.height}, 0, 0, cv::INTER_AREA);
    return image;
}

cv::Mat pixel_depths(const cv::Mat_<float>& samples, const cv::Size& size)
{
    cv::Mat depths(size, CV_32F);
    for (int row = 0; row < size.height; ++row)
        for (int column = 0; column < size.width; ++column)
        {
            PixelSamples of_pixel{};
            std::size_t next = 0;
            for (int y = 0; y < kSamplesPerSide; ++y)
                for (int x = 0; x < kSamplesPerSide; ++x)
                    of_pixel[next++] =
                        samples(row * kSamplesPerSide + y, column * kSamplesPerSide + x);
            depths.at<float>(row, column) = pixel_depth(of_pixel);
        }
    return depths;
}
}  // namespace

/** The OpenGL context of a thread. There is one, shared by all renderers: MRPT frees a texture's
 *  name late, when the next one is made, in whichever context is then the current one. */
class OffscreenRenderer::Context
{
 public:
    Context();
    ~Context() { OSMesaDestroyContext(context_); }
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;

    static std::shared_ptr<Context> of_this_thread()
    {
        thread_local std::weak_ptr<Context> existing;
        auto context = existing.lock();
        if (!context) existing = context = std::make_shared<Context>();
        return context;
    }

 private:
    OSMesaContext context_;
    std::array<unsigned char, 4> default_canvas_{};  // everything is drawn elsewhere, by CFBORender
};

OffscreenRenderer::Context::Context()
{
    const auto library = gl_library();
    if (library.find("libOSMesa") == std::string::npos)
        throw std::runtime_error("cannot draw off-screen: OpenGL functions come from " + library +
                                 ", not from libOSMesa; link OSMesa before all others");
    require_precise_shaders();
    // MRPT keeps one table of all threads' texture names, and deletes a name in the thread that
    // made it last: only contexts that share their names have none twice.
    static OSMesaContext const of_all_names = new_context(nullptr);
    context_ = new_context(of_all_names);
    if (context_ == nullptr)
        throw std::runtime_error("cannot draw off-screen: " + library +
                                 " gives no OpenGL 3.1 context; reinstall Debian's libosmesa6");
    if (OSMesaMakeCurrent(context_, default_canvas_.data(), GL_UNSIGNED_BYTE, 1, 1) == GL_FALSE)
    {
        OSMesaDestroyContext(context_);
        throw std::runtime_error("cannot draw off-screen: " + library +
                                 " refuses its own context; reinstall Debian's libosmesa6");
    }
    glPixelStorei(GL_PACK_ALIGNMENT, 1);  // MRPT reads rows of any length back
}

/** One target of drawing for each size of image that was asked for. */
struct OffscreenRenderer::Canvases
{
    std::map<std::pair<int, int>, mrpt::opengl::CFBORender> of_size;

    mrpt::opengl::CFBORender& get(const CameraModel& camera)
    {
        mrpt::opengl::CFBORender::Parameters parameters(
            static_cast<unsigned>(camera.width * kSamplesPerSide),
            static_cast<unsigned>(camera.height * kSamplesPerSide));
        parameters.create_EGL_context = false;  // ours is current
        return of_size.try_emplace({camera.width, camera.height}, parameters).first->second;
    }
};

OffscreenRenderer::OffscreenRenderer(std::shared_ptr<mrpt::opengl::COpenGLScene> scene,
                                     const ClipRange& clip)
    : context_(Context::of_this_thread()),
      canvases_(std::make_unique<Canvases>()),
      scene_(std::move(scene))
{
    scene_->getViewport()->setViewportClipDistances(static_cast<float>(clip.near_m),
                                                    static_cast<float>(clip.far_m));
    scene_->initializeTextures();
    filter_textures_by_mipmaps();
}

OffscreenRenderer::~OffscreenRenderer() = default;

mrpt::opengl::CFBORender& OffscreenRenderer::canvas_for(const CameraModel& camera,
                                                        const mrpt::poses::CPose3D& map_from_camera)
{
    check_camera(camera);
    mrpt::opengl::CCamera viewpoint;
    viewpoint.set6DOFMode(true);
    viewpoint.setProjectiveFromPinhole(sampling_camera(camera));
    viewpoint.setPose(map_from_camera);
    auto& canvas = canvases_->get(camera);
    canvas.setCamera(*scene_, viewpoint);
    return canvas;
}

RenderedView OffscreenRenderer::draw(const CameraModel& camera,
                                     const mrpt::poses::CPose3D& map_from_camera)
{
    auto& canvas = canvas_for(camera, map_from_camera);
    mrpt::img::CImage samples;
    mrpt::math::CMatrixFloat depth_samples;
    canvas.render_RGBD(*scene_, samples, depth_samples);

    RenderedView view;
    view.image = averaged(samples, camera);
    const cv::Size size(camera.width, camera.height);
    const auto sampled = size * kSamplesPerSide;
    view.depth =
        pixel_depths(cv::Mat_<float>(sampled.height, sampled.width, depth_samples.data()), size);
    return view;
}

cv::Mat OffscreenRenderer::draw_image(const CameraModel& camera,
                                      const mrpt::poses::CPose3D& map_from_camera)
{
    auto& canvas = canvas_for(camera, map_from_camera);
    mrpt::img::CImage samples;
    canvas.render_RGB(*scene_, samples);
    return averaged(samples, camera);
}

std::string OffscreenRenderer::gl_library()
{
    Dl_info info{};
    if (dladdr(reinterpret_cast<const void*>(&glGetString), &info) == 0) return "no library";
    return info.dli_fname;
}

}  // namespace fild
