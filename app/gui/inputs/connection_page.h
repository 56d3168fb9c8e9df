// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/receiving_state.h"
#include "app/gui/theme/theme.h"

#include <QWidget>

#include <vector>

class QLabel;
class QVBoxLayout;

namespace posewire::gui {

/// One finding of net::connectionHelp: what is known, and what to do.
class FindingView final : public QWidget {
    Q_OBJECT

public:
    explicit FindingView(QWidget* parent = nullptr);

    void setFinding(Health level, const QString& text, const QString& remedy);

protected:
    void changeEvent(QEvent* event) override;
    void paintEvent(QPaintEvent* event) override;

private:
    void applyColours();

    QLabel* m_symbol;
    QLabel* m_text;
    QLabel* m_remedy;
    Health m_level = Health::Unknown;
};

/// Why no characters are seen, as long as it is open; says so where nothing is wrong.
class ConnectionPage final : public QWidget {
    Q_OBJECT

public:
    explicit ConnectionPage(QWidget* parent = nullptr);

    void refresh(const ReceivingState& receiving);

    /// All that is shown, as lines.
    [[nodiscard]] QString text() const { return m_shown; }

signals:
    void copyRequested(const QString& text);

private:
    QVBoxLayout* m_column;
    std::vector<FindingView*> m_views;
    QString m_shown;
};

/// How bad a finding is.
[[nodiscard]] Health healthOf(net::Finding::Kind kind);

/// A finding's text or remedy as a sentence of its own.
[[nodiscard]] QString sentence(const std::string& text);

} // namespace posewire::gui
