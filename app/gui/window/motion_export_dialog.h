// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/base/background.h"
#include "core/export/motion/motion_export.h"
#include "core/model/session/session_view.h"

#include <QDialog>

#include <memory>

class QComboBox;
class QLabel;
class QListWidget;
class QPushButton;
class QTimer;

namespace posewire::gui {

class RangeBox;

/// Writes the motion of characters to files that other programs read. What is received goes on meanwhile; the
/// window waits only where this is closed before it is done.
class MotionExportDialog final : public QDialog {
    Q_OBJECT

public:
    /// The log of the session must outlive it.
    MotionExportDialog(model::SessionView& view, QWidget* parent);
    ~MotionExportDialog() override;

    /// Writes, on a thread of its own, what is chosen. A file that is there is replaced.
    void save(const QString& path);

private:
    using Result = tl::expected<std::vector<exporting::ExportedMotion>, log::FileError>;
    struct Job;

    [[nodiscard]] const exporting::MotionFormat& format() const;
    [[nodiscard]] std::vector<model::CharacterKey> chosen() const;
    void listCharacters();
    void describe();
    void toggle();
    void askWhereToSave();
    [[nodiscard]] std::shared_ptr<Job> jobFor(const QString& path) const;
    void begin(std::shared_ptr<Job> job);
    void watch();
    void showState(const QString& text);

    model::SessionView& m_view;
    QComboBox* m_format;
    QLabel* m_about;
    RangeBox* m_range;
    QListWidget* m_characters;
    QLabel* m_state;
    QPushButton* m_button;
    QTimer* m_watch;
    std::shared_ptr<Job> m_job; ///< written last, or now
    std::unique_ptr<Background<Result>> m_work;
};

} // namespace posewire::gui
