// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>

namespace posewire::gui {

/// One line of text and, dimmed, what is added to it. It never asks for room: where there is too little it
/// ends in an ellipsis.
class ElidedLabel final : public QWidget {
    Q_OBJECT

public:
    explicit ElidedLabel(Qt::Alignment alignment, QWidget* parent = nullptr);

    void setText(const QString& text, const QString& dim = {});
    [[nodiscard]] QString text() const { return m_text + m_dim; }

    [[nodiscard]] QSize sizeHint() const override;
    [[nodiscard]] QSize minimumSizeHint() const override;

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    Qt::Alignment m_alignment;
    QString m_text;
    QString m_dim;
};

} // namespace posewire::gui
