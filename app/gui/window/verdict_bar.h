// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/theme/theme.h"
#include "app/gui/theme/widgets.h"
#include "core/model/session/verdict.h"

#include <QAbstractButton>
#include <QStringList>
#include <QWidget>
#include <Qt>

class QAction;

namespace posewire::gui {

/// "● Good for the take: 4 characters", in the colour of what it says. A button: a click gives the evidence.
class Headline final : public QAbstractButton {
    Q_OBJECT

public:
    explicit Headline(QWidget* parent = nullptr);

    /// Tells screen readers when it says something else: a number that grows need not be spoken. `context`
    /// stands before it, where it is set.
    void setVerdict(const model::TakeVerdict& verdict, const QString& context);
    void setLarge(bool isLarge);

    [[nodiscard]] QSize sizeHint() const override;
    [[nodiscard]] QSize minimumSizeHint() const override;
    [[nodiscard]] std::optional<std::uint64_t> incident() const { return m_verdict.incident; }

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    [[nodiscard]] QString line() const { return healthText(m_level, text()); }
    /// As large as it should be, or as there is room for; `fits`: there is room for all of it.
    [[nodiscard]] QFont fontFor(int width, bool& fits) const;

    Health m_level = Health::Unknown;
    model::TakeVerdict m_verdict;
    QString m_narrow; ///< instead of text(), where that has no room
    bool m_isLarge = false;
};

struct ShownFile {
    QString name{}; ///< of the file that is open; empty where none is
    bool isShown = false;
    model::TakeVerdict verdict{}; ///< on all of it
    QStringList notes{};          ///< what else the operator must know of it
    QString comparison{};         ///< what is shown is compared with, and how; empty for nothing
};

/// Above everything: whether what is on the wire now is good for the take, whatever is shown; of a recording
/// that is shown while nothing has come, whether that is good. And, where the display is not live, what it
/// shows and how to come back.
class VerdictBar final : public QWidget {
    Q_OBJECT

public:
    struct Actions {
        QAction* reset;
        QAction* live;
        QAction* showFile;
        QAction* closeFile;
        QAction* endComparison;
        QAction* recovered;
    };
    /// `live` is the session of what is received.
    VerdictBar(model::SessionView& live, const Actions& actions, QWidget* parent = nullptr);

    void setLarge(bool isLarge);
    /// A line about what the last run has left, until it is looked at or put off.
    void showRecovery(const QString& text);
    /// `hasInputs`: there is something to be live with. `blocked`: why nothing can come from any of them.
    void refresh(const ShownFile& file, bool hasInputs, const QString& blocked = {});
    /// Asks for the evidence, as a click on the headline does.
    void showEvidence() { emit evidenceRequested(m_headline->incident(), m_isOfFile); }
    /// As last refreshed.
    [[nodiscard]] const model::TakeVerdict& verdict() const { return m_verdict; }

signals:
    /// The operator has dismissed the line about the last run.
    void recoveryDismissed();
    /// `incident` is what the verdict in the headline rests on, where it rests on one.
    void evidenceRequested(std::optional<std::uint64_t> incident, bool isOfFile);

private:
    void showVerdict(const ShownFile& file, const QString& blocked);
    void showStrip(const ShownFile& file, bool hasInputs);

    model::SessionView& m_live;
    Headline* m_headline = new Headline(this);
    QLabel* m_span = dimLabel({}, this);
    QToolButton* m_reset;
    QToolButton* m_showFile;
    QWidget* m_strip = new QWidget(this);
    ElidedLabel* m_what = new ElidedLabel(Qt::AlignLeft | Qt::AlignVCenter, m_strip);
    QToolButton* m_goLive;
    QToolButton* m_closeFile;
    QToolButton* m_endComparison;
    QToolButton* m_recovered;
    QToolButton* m_later = framedButton(tr("Later"), tr("It stays in the menu File"), m_strip);
    QString m_recovery;
    model::TakeVerdict m_verdict;
    bool m_isLarge = false;
    bool m_isOfFile = false; ///< what the headline says
};

} // namespace posewire::gui
