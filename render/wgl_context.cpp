// SPDX-License-Identifier: MIT
#include "render/offscreen.h"

#include <array>
#include <memory>
#include <string_view>
#include <type_traits>
#include <utility>

#include <windows.h>

// By Windows' own functions, not epoxy's: those need a library of their own that learns of every thread.
namespace posewire::render {
namespace {

// The extension WGL_ARB_create_context_profile.
using CreateContext = HGLRC(WINAPI*)(HDC, HGLRC, const int*);
constexpr int kMajorVersion = 0x2091;
constexpr int kMinorVersion = 0x2092;
constexpr int kProfileMask = 0x9126;
constexpr int kCoreProfile = 0x00000001;

constexpr const wchar_t* kWindowClass = L"posewire-offscreen";

struct WindowEnder {
    void operator()(HWND window) const { ::DestroyWindow(window); }
};
struct ContextEnder {
    void operator()(HGLRC context) const { ::wglDeleteContext(context); }
};
using Window = std::unique_ptr<std::remove_pointer_t<HWND>, WindowEnder>;
using Context = std::unique_ptr<std::remove_pointer_t<HGLRC>, ContextEnder>;

tl::unexpected<std::string> failure(std::string_view step) {
    const std::string code = std::to_string(::GetLastError());
    return tl::unexpected("WGL: " + std::string(step) + " failed (error " + code + ")");
}

/// A window that is never shown; null if Windows gives none. Its device context goes with it.
Window makeWindow() {
    WNDCLASSW type{};
    type.style = CS_OWNDC;
    type.lpfnWndProc = ::DefWindowProcW;
    type.hInstance = ::GetModuleHandleW(nullptr);
    type.lpszClassName = kWindowClass;
    ::RegisterClassW(&type); // fails if an earlier context has done it
    return Window(::CreateWindowExW(0, kWindowClass, L"", WS_POPUP, 0, 0, 1, 1, nullptr, nullptr,
                                    type.hInstance, nullptr));
}

bool choosePixels(HDC device) {
    PIXELFORMATDESCRIPTOR wanted{};
    wanted.nSize = sizeof wanted;
    wanted.nVersion = 1;
    wanted.dwFlags = PFD_DRAW_TO_WINDOW | PFD_SUPPORT_OPENGL;
    wanted.iPixelType = PFD_TYPE_RGBA;
    wanted.cColorBits = 32;
    const int format = ::ChoosePixelFormat(device, &wanted);
    return format != 0 && ::SetPixelFormat(device, format, &wanted) != FALSE;
}

/// The extension's function; null if the driver lacks it. Asks a context of OpenGL 1, which is current
/// meanwhile.
CreateContext findCreateContext(HDC device) {
    const Context first(::wglCreateContext(device));
    if (first == nullptr || ::wglMakeCurrent(device, first.get()) == FALSE) {
        return nullptr;
    }
    const auto found = reinterpret_cast<CreateContext>( // NOLINT: the API's own way
        reinterpret_cast<void*>(::wglGetProcAddress("wglCreateContextAttribsARB")));
    ::wglMakeCurrent(nullptr, nullptr);
    return found;
}

} // namespace

/// Belongs to the thread that made it: Windows lets no other end the window.
struct OffscreenContext::Impl {
    Window window;
    HDC device = nullptr;
    Context context;

    Impl() = default;
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;
    ~Impl() { release(); }

    void release() const {
        if (context != nullptr && ::wglGetCurrentContext() == context.get()) {
            ::wglMakeCurrent(nullptr, nullptr);
        }
    }
};

OffscreenContext::OffscreenContext(std::unique_ptr<Impl> impl) : m_impl(std::move(impl)) {}
OffscreenContext::OffscreenContext(OffscreenContext&&) noexcept = default;
OffscreenContext& OffscreenContext::operator=(OffscreenContext&&) noexcept = default;
OffscreenContext::~OffscreenContext() = default;

tl::expected<OffscreenContext, std::string> OffscreenContext::create() {
    auto impl = std::make_unique<Impl>();
    impl->window = makeWindow();
    if (impl->window == nullptr) {
        return failure("CreateWindowEx");
    }
    impl->device = ::GetDC(impl->window.get());
    if (!choosePixels(impl->device)) {
        return failure("SetPixelFormat");
    }
    const CreateContext create = findCreateContext(impl->device);
    if (create == nullptr) {
        return tl::unexpected(std::string("WGL: the display's driver has OpenGL 1 alone"));
    }
    constexpr std::array<int, 7> kAttributes{kMajorVersion, 3, kMinorVersion, 3, kProfileMask,
                                             kCoreProfile,  0};
    impl->context.reset(create(impl->device, nullptr, kAttributes.data()));
    if (impl->context == nullptr) {
        return failure("wglCreateContextAttribsARB");
    }
    OffscreenContext made(std::move(impl));
    if (!made.makeCurrent()) {
        return failure("wglMakeCurrent");
    }
    return made;
}

bool OffscreenContext::makeCurrent() {
    return ::wglMakeCurrent(m_impl->device, m_impl->context.get()) != FALSE;
}

void OffscreenContext::doneCurrent() {
    m_impl->release();
}

} // namespace posewire::render
