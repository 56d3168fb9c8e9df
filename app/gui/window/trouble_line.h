// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/theme/theme.h"

#include <QAbstractButton>

namespace posewire::gui {

/// A few lines of text behind the mark of its severity, with a dim note below; a button by mouse and
/// keyboard.
class TroubleLine final : public QAbstractButton {
    Q_OBJECT

public:
    TroubleLine(Health level, const QString& text, const QString& note, QWidget* parent);

    [[nodiscard]] QSize sizeHint() const override;
    [[nodiscard]] bool hasHeightForWidth() const override { return true; }
    [[nodiscard]] int heightForWidth(int width) const override;

protected:
    void paintEvent(QPaintEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;

private:
    [[nodiscard]] int margin() const { return fontMetrics().height() / 3; }
    [[nodiscard]] int markWidth() const;

    Health m_level;
    QString m_note;
};

} // namespace posewire::gui
