// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/viewport/presenter.h"

#include <QGuiApplication>
#include <QOffscreenSurface>
#include <QOpenGLContext>
#include <QOpenGLFunctions>
#include <QOpenGLWidget>
#include <QResizeEvent>

#include <algorithm>
#include <array>
#include <optional>
#include <string>

namespace posewire::gui {

namespace {

constexpr int kMajorVersion = 3;
constexpr int kMinorVersion = 3;

QSurfaceFormat surfaceFormat() {
    QSurfaceFormat format;
    format.setVersion(kMajorVersion, kMinorVersion);
    format.setProfile(QSurfaceFormat::CoreProfile);
    format.setOption(QSurfaceFormat::ResetNotification);
    return format;
}

std::string rendererName(QOpenGLContext& context) {
    constexpr unsigned kGlRenderer = 0x1F01;
    const auto* name = context.functions()->glGetString(kGlRenderer);
    return name == nullptr ? std::string() : reinterpret_cast<const char*>(name);
}

bool hasHardwareOpenGl() {
    constexpr std::array kPlatforms{"xcb", "wayland", "wayland-egl", "windows", "cocoa"};
    const QString platform = QGuiApplication::platformName();
    if (std::ranges::none_of(kPlatforms, [&](const char* name) { return platform == QLatin1String(name); })) {
        return false;
    }
    QOpenGLContext context;
    context.setFormat(surfaceFormat());
    if (!context.create()) {
        return false;
    }
    QOffscreenSurface surface;
    surface.setFormat(context.format());
    surface.create();
    if (!surface.isValid() || !context.makeCurrent(&surface)) {
        return false;
    }
    const bool isNewEnough = context.format().version() >= qMakePair(kMajorVersion, kMinorVersion);
    const bool isHardware = isNewEnough && !render::isSoftwareRenderer(rendererName(context));
    context.doneCurrent();
    return isHardware;
}

class View final : public QOpenGLWidget {
public:
    explicit View(QWidget* parent) : QOpenGLWidget(parent) {
        QSurfaceFormat format = surfaceFormat();
        format.setDepthBufferSize(24);
        setFormat(format);
        setAttribute(Qt::WA_TransparentForMouseEvents);
    }

    ~View() override { forget(); }

    void setFrame(std::shared_ptr<const SceneFrame> frame) {
        m_frame = std::move(frame);
        m_isWaiting = true;
        update();
    }

    [[nodiscard]] bool isWaiting() const { return m_isWaiting; }
    [[nodiscard]] bool shows(const SceneFrame& frame) const {
        return m_pictures > 0 && m_frame != nullptr && *m_frame == frame;
    }
    [[nodiscard]] const QString& failure() const { return m_failure; }
    [[nodiscard]] std::uint64_t pictures() const { return m_pictures; }
    [[nodiscard]] QString rendererName() const {
        return m_renderer ? QString::fromStdString(m_renderer->rendererName()) : QString();
    }

protected:
    void initializeGL() override {
        // Called again with a new context when the window moves to another screen's driver or is docked
        // again.
        connect(context(), &QOpenGLContext::aboutToBeDestroyed, this, [this] { forget(); });
        auto renderer = render::Renderer::create();
        if (!renderer) {
            m_failure = QString::fromStdString(renderer.error());
            return;
        }
        m_renderer.emplace(std::move(*renderer));
    }

    void paintGL() override {
        m_isWaiting = false;
        if (!m_renderer || m_frame == nullptr) {
            return;
        }
        const QSize pixels = size() * devicePixelRatioF(); // rounded as QOpenGLWidget does
        render::Viewport whole{pixels.width(), pixels.height(), defaultFramebufferObject(),
                               static_cast<float>(devicePixelRatioF())};
        if (m_frame->panes.empty()) {
            m_renderer->draw(m_upload.prepare(*m_frame, *m_renderer), whole);
        }
        for (const SceneFrame& pane : m_frame->panes) {
            m_renderer->drawPane(m_upload.prepare(pane, *m_renderer), pane.place(), whole);
            ++whole.view;
        }
        if (m_renderer->isContextLost()) {
            m_failure = tr("The graphics driver was reset.");
        }
        ++m_pictures;
    }

private:
    /// What is in the context is released in it.
    void forget() {
        makeCurrent();
        m_upload = {};
        m_renderer.reset();
        doneCurrent();
    }

    std::optional<render::Renderer> m_renderer;
    SceneUpload m_upload;
    std::shared_ptr<const SceneFrame> m_frame;
    QString m_failure;
    bool m_isWaiting = false;
    std::uint64_t m_pictures = 0;
};

class OpenGlPresenter final : public Presenter {
public:
    explicit OpenGlPresenter(QWidget* parent) : Presenter(parent) {
        connect(m_view, &QOpenGLWidget::frameSwapped, this, &Presenter::presented);
    }

    [[nodiscard]] bool isReady() const override { return !m_view->isWaiting() && failure().isEmpty(); }
    void present(std::shared_ptr<const SceneFrame> frame) override {
        if (m_view->shows(*frame)) {
            QMetaObject::invokeMethod(this, &Presenter::presented, Qt::QueuedConnection);
            return;
        }
        m_view->setFrame(std::move(frame));
    }
    [[nodiscard]] QString rendererName() const override { return m_view->rendererName(); }
    [[nodiscard]] QString failure() const override { return m_view->failure(); }
    [[nodiscard]] PictureLoad load() const override { return {}; }
    [[nodiscard]] std::uint64_t pictures() const override { return m_view->pictures(); }

protected:
    void resizeEvent(QResizeEvent* event) override { m_view->setGeometry(QRect(QPoint(), event->size())); }

private:
    View* m_view = new View(this);
};

} // namespace

Presenter* makeOpenGlPresenter(QWidget* parent) {
    return hasHardwareOpenGl() ? new OpenGlPresenter(parent) : nullptr;
}

} // namespace posewire::gui
