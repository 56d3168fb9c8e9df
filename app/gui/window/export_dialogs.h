// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/base/background.h"
#include "app/gui/base/playback.h"
#include "app/gui/theme/widgets.h"
#include "app/gui/viewport/viewport_widget.h"
#include "app/gui/window/range_box.h"
#include "core/export/motion/motion_export.h"
#include "core/model/session/session_view.h"

#include <QDialog>

#include <QListWidget>
#include <QPushButton>
#include <QTimer>
#include <memory>

namespace posewire::gui {

/// Writes the motion of characters to files that other programs read. What is received goes on meanwhile; the
/// window waits only where this is closed before it is done.
class MotionExportDialog final : public QDialog {
    Q_OBJECT

public:
    /// The log of the session must outlive it.
    MotionExportDialog(model::SessionView& view, QWidget* parent);
    ~MotionExportDialog() override;

    /// Writes, on a thread of its own, what is chosen. A file that is there is replaced.
    void save(const QString& path) { begin(jobFor(path)); }

private:
    using Result = tl::expected<std::vector<exporting::ExportedMotion>, log::FileError>;
    struct Job;

    [[nodiscard]] const exporting::MotionFormat& format() const;
    [[nodiscard]] std::vector<model::CharacterKey> chosen() const;
    void listCharacters();
    void describe();
    void toggle();
    [[nodiscard]] std::shared_ptr<Job> jobFor(const QString& path) const;
    void begin(std::shared_ptr<Job> job);
    void watch();
    void showState(const QString& text);

    model::SessionView& m_view;
    QComboBox* m_format = new ComboBox(this);
    QLabel* m_about = dimText({}, this);
    RangeBox* m_range = new RangeBox(m_view, this);
    QListWidget* m_characters = new QListWidget(this);
    QLabel* m_state = dimText({}, this);
    QPushButton* m_button = new QPushButton(this);
    QTimer* m_watch = new QTimer(this);
    std::shared_ptr<Job> m_job; ///< written last, or now
    std::unique_ptr<Background<Result>> m_work;
};

/// Asks which pictures of the viewport to write as PNG, of this moment or a series of a time, and writes them
/// until it is closed. The window shows the moments as they are drawn; what is received goes on meanwhile.
void showPicturesDialog(const Commands& commands, Playback& playback, const ComparisonState& comparison,
                        const ViewportWidget& viewport, QWidget* parent);

} // namespace posewire::gui
