// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/theme/theme.h"

#include <QAbstractButton>

namespace posewire::gui {

/// A button of one short line in the colour of its health, as in the bar at the bottom.
class ColourText final : public QAbstractButton {
    Q_OBJECT

public:
    /// Plain is dim text, Pill has an outline about it.
    enum class Look { Plain, Pill };

    explicit ColourText(Look look, QWidget* parent = nullptr);

    /// Unknown is dim text without a symbol.
    void setContent(Health level, const QString& text);
    [[nodiscard]] Health level() const { return m_level; }

    /// Pixels beside the text of a plain one, on both sides together.
    [[nodiscard]] static int marginsOf(const QFontMetrics& metrics) { return 2 * (metrics.height() / 4 + 1); }

    [[nodiscard]] QSize sizeHint() const override;
    [[nodiscard]] QSize minimumSizeHint() const override { return sizeHint(); }

protected:
    void paintEvent(QPaintEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;

private:
    Look m_look;
    Health m_level = Health::Unknown;
};

} // namespace posewire::gui
