// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/base/playback.h"
#include "app/gui/viewport/view_look.h"
#include "app/gui/viewport/viewport_overlay.h"
#include "core/log/time.h"
#include "core/model/session/session_view.h"

#include <QByteArray>
#include <QImage>
#include <QObject>
#include <QSize>
#include <QString>
#include <QWidget>

#include <future>
#include <memory>

namespace posewire::gui {

class DrawingThread;

struct PictureRequest {
    log::Stamp first{};
    log::Duration every{};
    int count = 1;
    QSize size;      ///< pixels
    qreal scale = 1; ///< pixels of the picture for one of a label
    QString path;    ///< of a PNG; of several pictures each has its number before the suffix

    /// Of a picture by its number from 0: the path itself where there is one alone.
    [[nodiscard]] QString pathOf(int number) const;
};

/// Stops the display at one moment after the other and writes what the viewport would show there, drawn as
/// well as it can be, with its labels. Drawing and compressing take threads of their own; the window goes on.
/// What was shown before is shown again at the end.
class PictureSeries final : public QObject {
    Q_OBJECT

public:
    /// Session and playback must outlive it.
    PictureSeries(model::SessionView& session, Playback& playback, const ViewLook& look,
                  PictureRequest request);
    ~PictureSeries() override;

    /// What is compared is in the pictures as well: it outlives this.
    void setComparison(const ComparisonState* comparison) { m_builder.setComparison(comparison); }
    void start() { showNext(); }
    /// Another session is shown: the display stays where it is.
    void leave() { m_isLeft = true; }
    [[nodiscard]] const PictureRequest& request() const { return m_request; }
    [[nodiscard]] int written() const { return m_written; }

signals:
    void progressed();
    /// All are written; or why no more are, as a sentence.
    void finished(const QString& problem);

private:
    void showNext();
    void draw(double seconds);
    void take();
    void compose();
    /// False if what was compressed last could not be written.
    [[nodiscard]] bool writeCompressed();
    void end(const QString& problem);

    model::SessionView& m_session;
    Playback& m_playback;
    ViewLook m_look;
    PictureRequest m_request;
    SceneBuilder m_builder;
    QWidget m_host; ///< of the overlay; never shown
    ViewportOverlay* m_overlay = new ViewportOverlay(&m_host);
    bool m_wasLive;
    log::Stamp m_shownBefore;
    int m_shown = 0; ///< moments so far
    int m_written = 0;
    bool m_isOver = false;
    bool m_isLeft = false;
    std::shared_ptr<const SceneFrame> m_frame;
    QImage m_drawn; ///< without words
    std::future<QByteArray> m_compressed;
    std::unique_ptr<DrawingThread> m_thread; ///< last: it calls back
};

} // namespace posewire::gui
