// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/panels/filter_bar.h"

#include "app/gui/theme/theme.h"

#include <QAction>
#include <QJsonArray>
#include <QMenu>

namespace posewire::gui {

namespace {

constexpr std::size_t kSavedFilters = 40;
constexpr qsizetype kLongestName = 60;
constexpr int kProgressSteps = 1000;
constexpr qint64 kLongWait = 300; ///< ms

} // namespace

std::vector<FilterBar::Saved> defaultFilters() {
    return {
        {FilterBar::tr("Problems"),
         QStringLiteral("malformed || foreign || gap > 0 || duplicate || reordered || restart || notice || "
                        "drops > 0")},
        {FilterBar::tr("Pose"), QStringLiteral("type in {01, 02, 05}")},
        {FilterBar::tr("Meta && scale"), QStringLiteral("type in {10, 11, 12, 13}")}};
}

FilterBar::FilterBar(QWidget* parent) : QWidget(parent), m_line(new FilterLine(m_problem, this)) {
    layOut();
    connect(m_back, &QPushButton::clicked, this, &FilterBar::backRequested);
    setSaved(defaultFilters());
}

void FilterBar::layOut() {
    auto* row = spacedRow({8, 6, 8, 6}, 6);
    row->addWidget(m_line, 1);
    row->addWidget(m_buttons);
    m_line->setMinimumWidth(fontMetrics().averageCharWidth() * 26); // the buttons give way first
    auto* cancel = new QPushButton(tr("Cancel"), m_progressRow);
    cancel->setObjectName(QStringLiteral("cancelFilter"));
    connect(cancel, &QPushButton::clicked, this, &FilterBar::cancelRequested);
    m_progress->setRange(0, kProgressSteps);
    m_progress->setAccessibleName(tr("Filtering"));
    m_progress->setFormat(tr("filtering · %p %"));
    auto* progressRow = spacedRow({8, 0, 8, 6}, -1, m_progressRow);
    progressRow->addWidget(m_progress, 1);
    progressRow->addWidget(cancel);
    m_problem->setObjectName(QStringLiteral("filterProblem"));
    m_problem->setContentsMargins(10, 0, 8, 6);
    m_problem->setWordWrap(true);
    auto* jumpRow = spacedRow({10, 0, 8, 6}, 8, m_jumpRow);
    auto* said = new ElidedLabel(Qt::AlignLeft, m_jumpRow);
    said->setText(tr("A jump put this filter here."));
    said->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
    jumpRow->addWidget(m_back);
    jumpRow->addWidget(said, 1);
    m_back->setObjectName(QStringLiteral("back"));
    auto* column = tightColumn(this);
    column->addLayout(row);
    for (QWidget* part : {static_cast<QWidget*>(m_problem), m_jumpRow, m_progressRow}) {
        column->addWidget(part);
        part->hide();
    }
}

void FilterBar::setJump(const std::optional<QString>& before) {
    m_jumpRow->setVisible(before.has_value());
    if (before) {
        constexpr int kShown = 32; // characters
        QString filter =
            fontMetrics().elidedText(*before, Qt::ElideRight, fontMetrics().averageCharWidth() * kShown);
        filter.replace(QLatin1Char('&'), QLatin1String("&&"));
        m_back->setText(before->isEmpty() ? tr("← Back to all packets") : tr("← Back to %1").arg(filter));
        m_back->setToolTip(
            toolTipText(tr("%1 (Alt+Left)").arg(before->isEmpty() ? tr("No filter") : *before)));
    }
}

void FilterBar::focusLine() {
    m_line->setFocus(Qt::ShortcutFocusReason);
    m_line->selectAll();
}

void FilterBar::setProgress(std::optional<double> share) {
    if (!share) {
        m_busySince.invalidate();
    } else if (!m_busySince.isValid()) {
        m_busySince.start();
    }
    m_progress->setValue(static_cast<int>(share.value_or(0) * kProgressSteps));
    m_progressRow->setVisible(share && m_busySince.elapsed() >= kLongWait);
}

void FilterBar::setSaved(std::vector<Saved> saved) {
    m_saved = std::move(saved);
    m_buttons->clear();
    for (std::size_t i = 0; i < m_saved.size(); ++i) {
        QAction* action = m_buttons->addCommand({}, m_saved[i].name, m_saved[i].text);
        connect(action, &QAction::triggered, this, [this, i] { applySaved(i); });
        QWidget* button = m_buttons->widgetForAction(action);
        button->setAccessibleName(tr("Filter packets: %1").arg(button->accessibleName()));
        button->setAccessibleDescription(m_saved[i].text);
        button->setContextMenuPolicy(Qt::CustomContextMenu);
        connect(button, &QWidget::customContextMenuRequested, this,
                [this, i, button](const QPoint& place) { askAbout(i, button->mapToGlobal(place)); });
    }
    connect(m_buttons->addCommand({}, QStringLiteral("+"), tr("Save this filter as a button")),
            &QAction::triggered, this, &FilterBar::saveCurrent);
}

void FilterBar::listSaved(QMenu& menu) {
    for (std::size_t i = 0; i < m_saved.size(); ++i) {
        menu.addAction(m_saved[i].name, this, [this, i] { applySaved(i); });
    }
}

void FilterBar::applySaved(std::size_t index) {
    m_line->setText(m_saved[index].text);
    m_line->apply();
}

void FilterBar::saveCurrent() {
    std::vector<Saved> saved = m_saved;
    if (!m_line->check() || m_line->filter().isEmpty() || saved.size() >= kSavedFilters) {
        m_line->setFocus();
    } else if (const QString name = askForName(tr("Save filter"), tr("Save"), {}); !name.isEmpty()) {
        saved.push_back({name, m_line->filter()});
        setSaved(std::move(saved));
    }
}

/// A name for a button; empty where the operator thinks better of it.
QString FilterBar::askForName(const QString& title, const QString& accept, QString before) {
    const auto problemOf = [](const QString& name) {
        return name.isEmpty() ? tr("A button needs a name.") : QString();
    };
    before.replace(QLatin1String("&&"), QLatin1String("&"));
    const TextPrompt words{title, tr("&Name on the button"), tr("Name"), accept, before};
    return askForText(words, problemOf, this)
        .value_or(QString())
        .replace(QLatin1Char('&'), QLatin1String("&&"));
}

void FilterBar::askAbout(std::size_t index, const QPoint& place) {
    QMenu menu(this);
    std::vector<Saved> saved = m_saved;
    menu.addAction(tr("&Rename…"), this, [&] {
        const QString name = askForName(tr("Rename filter"), tr("Rename"), saved[index].name);
        saved[index].name = name.isEmpty() ? saved[index].name : name;
    });
    menu.addAction(tr("Re&place with the filter in the line"), this, [&] {
        if (!m_line->error() && !m_line->filter().isEmpty()) {
            saved[index].text = m_line->filter();
        }
    });
    menu.addAction(tr("Re&move"), this,
                   [&] { saved.erase(saved.begin() + static_cast<std::ptrdiff_t>(index)); });
    menu.addSeparator();
    menu.addAction(tr("Restore the &default filters"), this, [&] { saved = defaultFilters(); });
    if (menu.exec(place) != nullptr) {
        setSaved(std::move(saved));
    }
}

QJsonObject FilterBar::state() const {
    QJsonObject state;
    if (!m_line->history().isEmpty()) {
        state["history"] = QJsonArray::fromStringList(m_line->history());
    }
    if (m_saved != defaultFilters()) {
        QJsonArray saved;
        for (const Saved& filter : m_saved) {
            saved.append(QJsonObject{{"name", filter.name}, {"filter", filter.text}});
        }
        state["saved"] = saved;
    }
    return state;
}

void FilterBar::restoreState(const QJsonObject& state) {
    QStringList history;
    for (const auto& text : state["history"].toArray()) {
        if (text.isString()) {
            history.append(text.toString());
        }
    }
    m_line->setHistory(history);
    if (!state["saved"].isArray()) {
        setSaved(defaultFilters());
        return;
    }
    std::vector<Saved> saved;
    const QJsonArray values = state["saved"].toArray();
    for (const auto& value : values) {
        const QJsonObject filter = value.toObject();
        if (!filter["name"].toString().isEmpty() && saved.size() < kSavedFilters) {
            saved.push_back({filter["name"].toString().left(kLongestName), filter["filter"].toString()});
        }
    }
    setSaved(std::move(saved));
}

} // namespace posewire::gui
