// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/panels/filter_bar.h"

#include "app/gui/theme/plain_text.h"
#include "app/gui/theme/theme.h"
#include "app/gui/theme/widgets.h"

#include <QAction>
#include <QHBoxLayout>
#include <QInputMethodEvent>
#include <QJsonArray>
#include <QLineEdit>
#include <QMenu>
#include <QProgressBar>
#include <QPushButton>
#include <QTextCharFormat>

namespace posewire::gui {

namespace {

constexpr qsizetype kHistory = 30;
constexpr qsizetype kSavedFilters = 40;
constexpr qsizetype kLongestName = 60;
constexpr int kProgressSteps = 1000;
constexpr qint64 kLongWait = 300; ///< ms

/// Place in a text of a place in its UTF-8.
int placeOf(const QString& text, std::size_t byte) {
    return static_cast<int>(QString::fromUtf8(text.toUtf8().left(static_cast<qsizetype>(byte))).size());
}

} // namespace

std::vector<FilterBar::Saved> defaultFilters() {
    return {
        {FilterBar::tr("Problems"),
         QStringLiteral("malformed || foreign || gap > 0 || duplicate || reordered || restart || notice || "
                        "drops > 0")},
        {FilterBar::tr("Pose"), QStringLiteral("type in {01, 02, 05}")},
        {FilterBar::tr("Meta && scale"), QStringLiteral("type in {10, 11, 12, 13}")}};
}

FilterBar::FilterBar(QWidget* parent)
    : QWidget(parent),
      m_line(new QLineEdit(this)),
      m_buttons(new CommandBar(this)),
      m_progressRow(new QWidget(this)),
      m_progress(new QProgressBar(this)),
      m_problem(plainLabel(this)),
      m_jumpRow(new QWidget(this)),
      m_back(new QPushButton(m_jumpRow)),
      m_saved(defaultFilters()) {
    m_line->setObjectName(QStringLiteral("displayFilter"));
    m_line->setAccessibleName(tr("Display filter"));
    m_line->setPlaceholderText(tr("Filter packets, such as type == 02 && gap > 0"));
    m_line->setClearButtonEnabled(true);
    m_line->setMaxLength(static_cast<int>(filter::Filter::kLongestText));
    m_line->setAcceptDrops(false); // a file that is dropped on it is the window's
    m_line->installEventFilter(this);
    layOut();
    makeCompleter();
    connect(m_line, &QLineEdit::textChanged, this, &FilterBar::check);
    connect(m_line, &QLineEdit::textEdited, this, [this](const QString& text) {
        if (text.isEmpty()) {
            apply();
            hideOffers();
        } else {
            offerCompletions();
        }
    });
    connect(m_line, &QLineEdit::returnPressed, this, &FilterBar::applyAndLeave);
    restyle();
    showSaved();
}

void FilterBar::layOut() {
    auto* row = spacedRow({8, 6, 8, 6}, 6);
    row->addWidget(m_line, 1);
    row->addWidget(m_buttons);
    m_line->setMinimumWidth(m_line->fontMetrics().averageCharWidth() * 26); // the buttons give way first
    auto* cancel = new QPushButton(tr("Cancel"), m_progressRow);
    cancel->setObjectName(QStringLiteral("cancelFilter"));
    connect(cancel, &QPushButton::clicked, this, &FilterBar::cancelRequested);
    m_progress->setRange(0, kProgressSteps);
    m_progress->setAccessibleName(tr("Filtering"));
    m_progress->setFormat(tr("filtering · %p %"));
    auto* progressRow = new QHBoxLayout(m_progressRow);
    progressRow->setContentsMargins(8, 0, 8, 6);
    progressRow->addWidget(m_progress, 1);
    progressRow->addWidget(cancel);
    m_progressRow->hide();
    m_problem->setContentsMargins(10, 0, 8, 6);
    m_problem->setWordWrap(true);
    m_problem->hide();
    auto* column = tightColumn(this);
    column->addLayout(row);
    column->addWidget(m_problem);
    layOutJump();
    column->addWidget(m_jumpRow);
    column->addWidget(m_progressRow);
}

void FilterBar::layOutJump() {
    auto* row = spacedRow({10, 0, 8, 6}, 8, m_jumpRow);
    auto* said = new ElidedLabel(Qt::AlignLeft, m_jumpRow);
    said->setText(tr("A jump put this filter here."));
    said->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
    row->addWidget(m_back);
    row->addWidget(said, 1);
    m_back->setObjectName(QStringLiteral("back"));
    connect(m_back, &QPushButton::clicked, this, &FilterBar::backRequested);
    m_jumpRow->hide();
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

QString FilterBar::text() const {
    return m_line->text().trimmed();
}

void FilterBar::setApplied(const QString& text) {
    m_appliedText = text;
    if (text != this->text()) {
        m_line->setText(text);
        m_line->setCursorPosition(0); // of a long one the beginning says more
    }
    restyle();
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

void FilterBar::check() {
    const auto compiled = filter::Filter::compile(text().toStdString());
    m_error = compiled ? std::nullopt : std::optional(compiled.error());
    restyle();
    // What is still being written is not wrong yet: the words come when the line is left or applied.
    if (!m_error || m_problem->isVisible()) {
        showError();
    }
    underline();
}

QString FilterBar::errorText() const {
    return m_problem->isHidden() ? QString() : m_problem->text();
}

void FilterBar::showError() {
    m_problem->setVisible(m_error.has_value());
    if (m_error) {
        setTextColour(*m_problem, theme().error);
        m_problem->setText(healthText(Health::Error, QString::fromStdString(m_error->text)) +
                           tr(" (at character %1)").arg(placeOf(text(), m_error->offset) + 1));
    }
}

/// A line edit draws formats where an input method asks for them.
void FilterBar::underline() {
    QList<QInputMethodEvent::Attribute> attributes;
    if (m_error) {
        const QString whole = m_line->text();
        const auto lead = static_cast<int>(whole.indexOf(text()));
        const int begin = lead + placeOf(text(), m_error->offset);
        const int end = lead + placeOf(text(), m_error->offset + std::max<std::size_t>(1, m_error->length));
        QTextCharFormat format;
        format.setUnderlineStyle(QTextCharFormat::WaveUnderline);
        format.setUnderlineColor(theme().error);
        attributes.append({QInputMethodEvent::TextFormat, begin - m_line->cursorPosition(),
                           std::max(1, end - begin), format});
    }
    QInputMethodEvent event({}, attributes);
    QCoreApplication::sendEvent(m_line, &event);
}

void FilterBar::restyle() {
    m_line->setFont(monospaceFont());
    const bool isApplied = text() == m_appliedText;
    QColor border = theme().accent;
    QColor fill = theme().panel;
    if (m_error) {
        border = theme().error;
        fill = tinted(border);
    } else if (text().isEmpty()) {
        border = theme().line;
    } else if (isApplied) {
        border = theme().good;
        fill = tinted(border);
    }
    m_line->setToolTip(
        toolTipText(isApplied ? tr("Alt and arrow down: earlier filters") : tr("Press Enter to filter")));
    if (m_error) {
        m_line->setToolTip(toolTipText(QString::fromStdString(m_error->text)));
    }
    const QString sheet =
        QStringLiteral("QLineEdit { border: 1px solid %1; background: %2; }").arg(border.name(), fill.name());
    if (m_line->styleSheet() != sheet) {
        m_line->setStyleSheet(sheet);
    }
}

void FilterBar::apply() {
    check();
    showError();
    if (m_error) {
        return;
    }
    remember(text());
    m_appliedText = text();
    restyle();
    emit applied(text());
}

/// One that is wrong is to be put right: the keyboard stays.
void FilterBar::applyAndLeave() {
    apply();
    if (!m_error) {
        emit left();
    }
}

void FilterBar::remember(const QString& text) {
    if (!text.isEmpty()) {
        m_history.removeAll(text);
        m_history.prepend(text);
        m_history = m_history.first(std::min(kHistory, m_history.size()));
    }
}

void FilterBar::setSaved(std::vector<Saved> saved) {
    m_saved = std::move(saved);
    showSaved();
}

void FilterBar::showSaved() {
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
    apply();
}

void FilterBar::saveCurrent() {
    check();
    if (text().isEmpty() || m_error || m_saved.size() >= static_cast<std::size_t>(kSavedFilters)) {
        showError();
        m_line->setFocus();
        return;
    }
    if (const QString name = askForName(tr("Save filter"), tr("Save"), {}); !name.isEmpty()) {
        m_saved.push_back({name, text()});
        showSaved();
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
    menu.addAction(tr("&Rename…"), this, [this, index] { rename(index); });
    menu.addAction(tr("Re&place with the filter in the line"), this, [this, index] {
        if (!m_error && !text().isEmpty()) {
            m_saved[index].text = text();
            showSaved();
        }
    });
    menu.addAction(tr("Re&move"), this, [this, index] {
        m_saved.erase(m_saved.begin() + static_cast<std::ptrdiff_t>(index));
        showSaved();
    });
    menu.addSeparator();
    menu.addAction(tr("Restore the &default filters"), this, [this] { setSaved(defaultFilters()); });
    menu.exec(place);
}

void FilterBar::rename(std::size_t index) {
    const QString name = askForName(tr("Rename filter"), tr("Rename"), m_saved[index].name);
    if (!name.isEmpty()) {
        m_saved[index].name = name;
        showSaved();
    }
}

QJsonObject FilterBar::state() const {
    QJsonObject state;
    if (!m_history.isEmpty()) {
        state["history"] = QJsonArray::fromStringList(m_history);
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
    m_history.clear();
    const QJsonArray history = state["history"].toArray();
    for (const auto& text : history) {
        if (text.isString() && m_history.size() < kHistory) {
            m_history.append(text.toString());
        }
    }
    if (!state["saved"].isArray()) {
        setSaved(defaultFilters());
        return;
    }
    std::vector<Saved> saved;
    const QJsonArray values = state["saved"].toArray();
    for (const auto& value : values) {
        const QJsonObject filter = value.toObject();
        if (!filter["name"].toString().isEmpty() && saved.size() < static_cast<std::size_t>(kSavedFilters)) {
            saved.push_back({filter["name"].toString().left(kLongestName), filter["filter"].toString()});
        }
    }
    setSaved(std::move(saved));
}

void FilterBar::changeEvent(QEvent* event) {
    QWidget::changeEvent(event);
    if (event->type() == QEvent::PaletteChange) {
        restyle();
        if (m_problem->isVisible()) {
            showError();
        }
    }
}

} // namespace posewire::gui
