// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/viewport/opengl_presenter.h"

#include "app/gui/viewport/scene_upload.h"

#include <QOpenGLContext>
#include <QOpenGLWidget>
#include <QResizeEvent>

#include <optional>

namespace posewire::gui {

class OpenGlPresenter::View final : public QOpenGLWidget {
public:
    explicit View(OpenGlPresenter* presenter) : QOpenGLWidget(presenter) {
        QSurfaceFormat format;
        format.setVersion(3, 3);
        format.setProfile(QSurfaceFormat::CoreProfile);
        format.setDepthBufferSize(24);
        setFormat(format);
        setAttribute(Qt::WA_TransparentForMouseEvents);
    }

    ~View() override {
        makeCurrent();
        forget();
        doneCurrent();
    }

    void setFrame(std::shared_ptr<const SceneFrame> frame) {
        m_frame = std::move(frame);
        m_isWaiting = true;
        update();
    }

    [[nodiscard]] bool isWaiting() const { return m_isWaiting; }
    [[nodiscard]] const QString& failure() const { return m_failure; }
    [[nodiscard]] QString rendererName() const {
        return m_renderer ? QString::fromStdString(m_renderer->rendererName()) : QString();
    }

protected:
    void initializeGL() override {
        // Called again with a new context when the window moves to another screen's driver or is docked anew.
        connect(context(), &QOpenGLContext::aboutToBeDestroyed, this, [this] {
            makeCurrent();
            forget();
            doneCurrent();
        });
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
        const render::Scene scene = m_upload.prepare(*m_frame, *m_renderer);
        const auto ratio = static_cast<float>(devicePixelRatioF());
        const render::Viewport viewport{static_cast<int>(static_cast<float>(width()) * ratio),
                                        static_cast<int>(static_cast<float>(height()) * ratio),
                                        defaultFramebufferObject(), ratio};
        m_renderer->draw(scene, viewport);
    }

private:
    void forget() {
        m_upload = {};
        m_renderer.reset();
    }

    std::optional<render::Renderer> m_renderer;
    SceneUpload m_upload;
    std::shared_ptr<const SceneFrame> m_frame;
    QString m_failure;
    bool m_isWaiting = false;
};

OpenGlPresenter::OpenGlPresenter(QWidget* parent) : Presenter(parent), m_view(new View(this)) {
    connect(m_view, &QOpenGLWidget::frameSwapped, this, &Presenter::presented);
}

OpenGlPresenter::~OpenGlPresenter() = default;

bool OpenGlPresenter::isReady() const {
    return !m_view->isWaiting() && failure().isEmpty();
}

void OpenGlPresenter::present(std::shared_ptr<const SceneFrame> frame) {
    m_view->setFrame(std::move(frame));
}

QString OpenGlPresenter::rendererName() const {
    return m_view->rendererName();
}

QString OpenGlPresenter::failure() const {
    return m_view->failure();
}

void OpenGlPresenter::resizeEvent(QResizeEvent* event) {
    m_view->setGeometry(QRect(QPoint(), event->size()));
}

} // namespace posewire::gui
