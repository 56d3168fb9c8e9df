// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/base/playback.h"
#include "app/gui/viewport/picture_series.h"
#include "app/gui/viewport/viewport_widget.h"

#include <QDialog>

#include <memory>

class QComboBox;
class QLabel;
class QPushButton;
class QSpinBox;

namespace posewire::gui {

/// Writes what the viewport shows as PNG: of this moment, or a series of a time. The window shows the moments
/// as they are drawn; what is received goes on meanwhile.
class PicturesDialog final : public QDialog {
    Q_OBJECT

public:
    PicturesDialog(const Commands& commands, Playback& playback, const ComparisonState& comparison,
                   const ViewportWidget& viewport, QWidget* parent);
    /// What has been written stays.
    ~PicturesDialog() override;

    /// Begins to write what is chosen. Files that are there are replaced.
    void save(const QString& path);
    /// What it says about what is written, or was.
    [[nodiscard]] QString stateText() const;

signals:
    void finished();

private:
    [[nodiscard]] model::TimeRange time() const;
    [[nodiscard]] PictureRequest request(const QString& path) const;
    void describe();
    void toggle();
    void askWhereToSave();
    void end(const QString& text);

    const Commands& m_commands; ///< what is shown
    Playback& m_playback;
    const ComparisonState& m_comparison;
    const ViewportWidget& m_viewport;
    QComboBox* m_what;
    QSpinBox* m_rate;
    QComboBox* m_size;
    QLabel* m_about;
    QLabel* m_state;
    QPushButton* m_button;
    std::unique_ptr<PictureSeries> m_series; ///< null where nothing is written
};

} // namespace posewire::gui
