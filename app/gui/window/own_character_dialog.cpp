// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/window/own_character_dialog.h"

#include "app/gui/models/text.h"
#include "app/gui/theme/theme.h"
#include "app/gui/viewport/bodies.h"
#include "app/gui/viewport/camera_motion.h"
#include "app/gui/viewport/presenter.h"

#include <QDialogButtonBox>
#include <QFileDialog>
#include <QFileInfo>
#include <QFormLayout>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QUrl>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>
#include <utility>

namespace posewire::gui {

namespace {

/// Metres of a unit, in the order of the list; 0 finds it.
constexpr std::array kUnits{0.0F, 1.0F, 0.01F, 0.001F, 0.0254F, 0.3048F};

enum Rest : std::uint8_t { Straightened, AsItIs };
enum Size : std::uint8_t { OfPerformer, OfFile };

QString unitName(float unit) {
    const std::array names{OwnCharacterDialog::tr("metres"), OwnCharacterDialog::tr("centimetres"),
                           OwnCharacterDialog::tr("millimetres"), OwnCharacterDialog::tr("inches"),
                           OwnCharacterDialog::tr("feet")};
    for (std::size_t i = 1; i < kUnits.size(); ++i) {
        if (std::abs(unit - kUnits.at(i)) < 1e-3F * kUnits.at(i)) {
            return names.at(i - 1);
        }
    }
    return OwnCharacterDialog::tr("units of %1 m").arg(static_cast<double>(unit));
}

QString restName(float armsBelowLevel) {
    constexpr float kLevel = 12.0F; // degrees
    constexpr float kHanging = 70.0F;
    return armsBelowLevel < -kLevel  ? OwnCharacterDialog::tr("arms raised")
           : armsBelowLevel < kLevel ? OwnCharacterDialog::tr("T-pose")
           : armsBelowLevel < kHanging
               ? OwnCharacterDialog::tr("A-pose, arms %1° down").arg(std::lround(armsBelowLevel))
               : OwnCharacterDialog::tr("arms hanging");
}

/// The file that a text names, as people paste it: in quotation marks, or as the address of a file.
QString pastedPath(const QString& text) {
    QString path = text.trimmed();
    const bool isQuoted =
        path.size() > 1 && path.front() == path.back() && QStringLiteral("\"'").contains(path.front());
    path = isQuoted ? path.mid(1, path.size() - 2) : path;
    const QUrl url(path);
    return url.isLocalFile() ? url.toLocalFile() : path;
}

QString recognition(const render::BoneMapping& mapping) {
    if (mapping.naming != nullptr) {
        return OwnCharacterDialog::tr("named as by %1").arg(fromUtf8(mapping.naming->title));
    }
    return mapping == render::BoneMapping() ? OwnCharacterDialog::tr("names not recognised")
                                            : OwnCharacterDialog::tr("found without a known naming");
}

/// Titles of the segments whose bones are guesses of the skeleton's shape.
QStringList guessed(const render::BoneMapping& mapping) {
    QStringList titles;
    for (std::size_t i = 0; i < render::kMappableCount; ++i) {
        if (mapping.bones.at(i) >= 0 && mapping.foundBy.at(i) == render::FoundBy::Shape) {
            titles += fromUtf8(render::mappableTitle(i));
        }
    }
    return titles;
}

/// The mannequin's palette in the T-pose, each hand as flat as in the scale message.
std::array<render::DualQuaternion, render::kJointCount> tPose() {
    std::array<glm::vec3, render::kSegmentCount> positions = render::kReferenceNullPose;
    std::array<glm::quat, render::kSegmentCount> turns{};
    turns.fill(glm::quat(1, 0, 0, 0));
    std::array<glm::vec3, render::kFingerJointCount> fingers{};
    std::array<glm::quat, render::kFingerJointCount> fingerTurns{};
    fingerTurns.fill(glm::quat(1, 0, 0, 0));
    for (std::size_t i = 0; i < fingers.size(); ++i) {
        fingers[i] = render::jointOrigin(render::kFirstFingerJoint + i);
    }
    constexpr std::size_t kHand = render::kHandSegmentCount;
    std::array<render::DualQuaternion, render::kJointCount> palette{};
    const render::PaletteJob job{positions,
                                 turns,
                                 render::kReferenceNullPose,
                                 palette,
                                 {std::span(fingers).first(kHand), std::span(fingerTurns).first(kHand)},
                                 {std::span(fingers).last(kHand), std::span(fingerTurns).last(kHand)},
                                 fingers};
    job.run();
    return palette;
}

} // namespace

/// A body in MVN's T-pose on a floor of its own; dragging turns it.
class BodyPreview final : public QWidget {
public:
    explicit BodyPreview(QWidget* parent) : QWidget(parent), m_presenter(makeSoftwarePresenter(this)) {
        setFocusPolicy(Qt::StrongFocus);
        setAccessibleName(tr("The character in the T-pose; arrow keys turn it"));
        setMinimumSize(fontMetrics().averageCharWidth() * 36, fontMetrics().height() * 18);
        m_presenter->setAttribute(Qt::WA_TransparentForMouseEvents);
        connect(m_presenter, &Presenter::presented, this, [this] {
            if (std::exchange(m_isWaiting, false)) {
                draw();
            }
        });
        connect(m_presenter, &Presenter::ready, this, &BodyPreview::draw);
        connect(m_presenter, &Presenter::outgrown, this, &BodyPreview::draw);
        constexpr float kAside = 0.45F;
        m_motion.turn(kAside);
    }

    /// Null shows the empty floor.
    void setBody(std::shared_ptr<const DressedBody> body) {
        m_figure = {};
        if (body != nullptr) {
            m_figure.palette = tPose();
            m_figure.own = sized(std::move(body), 1.0F);
            const render::OwnBody& own = m_figure.own->dressed->body;
            m_figure.bones.resize(own.joints.size());
            render::OwnPaletteJob{&own, 1.0F, m_figure.palette, render::kReferenceNullPose, m_figure.bones}
                .run();
            const QColor colour = theme().accent;
            m_figure.look.colour = {static_cast<float>(colour.redF()), static_cast<float>(colour.greenF()),
                                    static_cast<float>(colour.blueF())};
        }
        render::Bounds box;
        for (std::size_t i = 0; m_figure.own != nullptr && i < m_figure.own->mesh.vertexCount(); ++i) {
            box.add(m_figure.own->mesh.positions[i]);
        }
        if (!box.isEmpty()) {
            m_motion.show(box, static_cast<float>(std::max(1, width())) /
                                   static_cast<float>(std::max(1, height())));
        }
        draw();
    }
    [[nodiscard]] QSize sizeHint() const override {
        return {fontMetrics().averageCharWidth() * 52, fontMetrics().height() * 26};
    }

protected:
    void resizeEvent(QResizeEvent* /*event*/) override {
        m_presenter->setGeometry(rect());
        draw();
    }
    void mousePressEvent(QMouseEvent* event) override { m_pointer = event->position(); }
    void mouseMoveEvent(QMouseEvent* event) override {
        m_motion.orbit(event->position() - std::exchange(m_pointer, event->position()));
        draw();
    }
    void keyPressEvent(QKeyEvent* event) override {
        constexpr qreal kStep = 20; // as of a pointer, logical pixels
        const QPointF step = event->key() == Qt::Key_Left    ? QPointF(-kStep, 0)
                             : event->key() == Qt::Key_Right ? QPointF(kStep, 0)
                             : event->key() == Qt::Key_Up    ? QPointF(0, -kStep)
                             : event->key() == Qt::Key_Down  ? QPointF(0, kStep)
                                                             : QPointF();
        if (step.isNull()) {
            QWidget::keyPressEvent(event);
            return;
        }
        m_motion.orbit(step);
        draw();
    }

private:
    void draw() {
        if (width() < 1 || height() < 1) {
            return;
        }
        if (!m_presenter->isReady()) {
            m_isWaiting = true;
            return;
        }
        auto frame = std::make_shared<SceneFrame>();
        frame->pixelRatio = static_cast<float>(devicePixelRatioF());
        frame->width = std::max(1, qRound(width() * devicePixelRatioF()));
        frame->height = std::max(1, qRound(height() * devicePixelRatioF()));
        frame->colours = themedSceneColours();
        frame->camera = m_motion.camera();
        if (m_figure.own != nullptr) {
            frame->figures.push_back(m_figure);
        }
        m_presenter->present(std::move(frame));
    }

    Presenter* m_presenter;
    Figure m_figure; ///< without anything drawn for none
    CameraMotion m_motion;
    QPointF m_pointer;
    bool m_isWaiting = false; ///< for the presenter to be ready
};

OwnCharacterDialog::OwnCharacterDialog(OwnCharacters& characters, const QStringList& names,
                                       const QString& selected, QWidget* parent)
    : QDialog(parent), m_characters(characters), m_preview(new BodyPreview(this)) {
    setWindowTitle(tr("Own character"));
    m_who->addItem(tr("All characters"), QString());
    for (const QString& name : names) {
        m_who->addItem(name, name);
    }
    m_who->setCurrentIndex(std::max(0, m_who->findData(selected)));
    makeForm();
    resize(QSize(66, 38) * fontMetrics().height());
    const QJsonObject kept = characters.keptFor(who());
    if (const QString path = kept["file"].toString(); !path.isEmpty()) {
        read(path);
    } else {
        describe();
    }
}

void OwnCharacterDialog::makeForm() {
    m_path->setPlaceholderText(tr("A file of glTF, FBX or Collada with a skinned mesh"));
    m_path->setAccessibleName(tr("File of the character"));
    m_unit->addItems(
        {tr("As found"), tr("Metres"), tr("Centimetres"), tr("Millimetres"), tr("Inches"), tr("Feet")});
    m_heading->addItems({tr("As found"), tr("A quarter turn to the left"), tr("Half a turn"),
                         tr("A quarter turn to the right")});
    m_rest->addItems({tr("Turn it into the T-pose"), tr("It is a T-pose")});
    m_size->addItems({tr("As tall as the performer"), tr("As tall as in the file")});
    auto* file = spacedRow({}, 8);
    file->addWidget(m_path, 1);
    file->addWidget(m_again);
    file->addWidget(m_browse);
    auto* form = new QFormLayout;
    form->addRow(tr("&Unit"), m_unit);
    form->addRow(tr("&Heading"), m_heading);
    form->addRow(tr("&Rest pose"), m_rest);
    form->addRow(tr("&Size"), m_size);
    auto* left = new QVBoxLayout;
    left->addWidget(m_preview, 1);
    left->addWidget(m_state);
    auto* middle = spacedRow({}, fontMetrics().height());
    middle->addLayout(left, 1);
    auto* right = new QVBoxLayout;
    right->addLayout(form);
    right->addWidget(m_table, 1);
    middle->addLayout(right);
    auto* target = new QFormLayout;
    target->addRow(tr("F&or"), m_who);
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Cancel, this);
    buttons->addButton(m_mannequin, QDialogButtonBox::ResetRole);
    buttons->addButton(m_apply, QDialogButtonBox::AcceptRole);
    m_apply->setDefault(true);
    auto* column = new QVBoxLayout(this);
    column->setSpacing(fontMetrics().height());
    column->addLayout(file);
    column->addLayout(middle, 1);
    column->addLayout(target);
    column->addWidget(buttons);
    connect(m_browse, &QPushButton::clicked, this, &OwnCharacterDialog::askForFile);
    connect(m_path, &QLineEdit::returnPressed, this, [this] {
        if (const QString path = pastedPath(m_path->text()); !path.isEmpty()) {
            read(path, true);
        }
    });
    connect(m_again, &QPushButton::clicked, this, [this] { read(pastedPath(m_path->text()), true); });
    for (QComboBox* each : {m_unit, m_heading, m_rest, m_size}) {
        connect(each, &QComboBox::activated, this, &OwnCharacterDialog::makeBody);
    }
    connect(m_table, &BoneTable::corrected, this, &OwnCharacterDialog::correct);
    connect(m_who, &QComboBox::activated, this, &OwnCharacterDialog::describe);
    connect(m_mannequin, &QPushButton::clicked, this, [this] {
        m_characters.undress(who());
        QDialog::accept();
    });
    connect(buttons, &QDialogButtonBox::accepted, this, &OwnCharacterDialog::accept);
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
}

QString OwnCharacterDialog::who() const {
    return m_who->currentData().toString();
}

void OwnCharacterDialog::askForFile() {
    const QString path =
        QFileDialog::getOpenFileName(this, windowTitle(), QFileInfo(m_path->text()).absolutePath(),
                                     tr("Characters (*.glb *.gltf *.vrm *.fbx *.dae)"));
    if (!path.isEmpty()) {
        read(path, true);
    }
}

void OwnCharacterDialog::read(const QString& path, bool isAgain) {
    m_path->setText(path);
    m_isReading = true;
    describe();
    m_reading.begin(
        path, [this](const ReadCharacter& file) { take(file); }, isAgain);
}

/// A file that cannot be read changes nothing but the words.
void OwnCharacterDialog::take(const ReadCharacter& file) {
    m_isReading = false;
    if (!file) {
        m_problem = file.error();
        m_file.reset();
        m_body.reset();
        m_preview->setBody(nullptr);
        describe();
    } else {
        m_file = *file;
        const QJsonObject kept = m_characters.keptFor(who());
        const bool isKept = kept["sum"].toString() == m_file->sum ||
                            kept["file"].toString() == QFileInfo(m_file->path).absoluteFilePath();
        // What was chosen for another file is of no use here.
        showChoice(choiceOf(isKept ? kept : QJsonObject()));
        makeBody();
    }
    emit finished();
}

void OwnCharacterDialog::showChoice(const BodyChoice& choice) {
    const auto unit = std::ranges::find(kUnits, choice.rest.unit);
    m_unit->setCurrentIndex(unit == kUnits.end() ? 0 : static_cast<int>(unit - kUnits.begin()));
    m_heading->setCurrentIndex(choice.rest.quarterTurns);
    m_rest->setCurrentIndex(choice.rest.isStraightened ? Straightened : AsItIs);
    m_size->setCurrentIndex(choice.isScaled ? OfPerformer : OfFile);
    m_bones = choice.bones;
}

BodyChoice OwnCharacterDialog::choice() const {
    BodyChoice choice;
    choice.rest = {kUnits.at(static_cast<std::size_t>(m_unit->currentIndex())), m_heading->currentIndex(),
                   m_rest->currentIndex() == Straightened};
    choice.isScaled = m_size->currentIndex() == OfPerformer;
    choice.bones = m_bones;
    return choice;
}

void OwnCharacterDialog::correct(std::size_t mappable, const QString& bone) {
    std::erase_if(m_bones, [&](const auto& one) {
        return one.mappable == mappable || (!bone.isEmpty() && fromUtf8(one.bone) == bone);
    });
    m_bones.push_back({mappable, bone.toStdString()});
    makeBody();
}

void OwnCharacterDialog::makeBody() {
    if (m_file == nullptr) {
        return;
    }
    auto body = bodyOf(*m_file, choice());
    m_body = body ? *body : nullptr;
    m_problem = body ? QString() : tr("It cannot be posed: %1.").arg(body.error());
    m_preview->setBody(m_body);
    describe();
}

void OwnCharacterDialog::describe() {
    QStringList lines;
    if (m_isReading) {
        lines += tr("Reading %1 …").arg(QFileInfo(m_path->text()).fileName());
    } else if (m_file == nullptr && m_problem.isEmpty()) {
        lines += tr("Bones are recognised by their names, as %1 name them.")
                     .arg(QString::fromStdString(render::knownNamings()));
    }
    if (!m_isReading && m_file != nullptr) {
        const render::ImportedCharacter& character = m_file->character;
        QStringList unfit;
        const render::BoneMapping mapping = mappingOf(*m_file, choice(), &unfit);
        m_table->setMapping(mapping, character.bones);
        lines += tr("Bones %1 (%2) · vertices %3")
                     .arg(QString::number(character.bones.size()), recognition(m_file->mapping),
                          grouped(character.mesh.vertexCount()));
        if (const QStringList shape = guessed(mapping); !shape.isEmpty()) {
            lines += tr("Guessed by the skeleton's shape, check the preview: %1")
                         .arg(shape.join(QStringLiteral(", ")));
        }
        if (!unfit.isEmpty()) {
            lines += tr("The file no longer has the bones that were chosen for %1")
                         .arg(unfit.join(QStringLiteral(", ")));
        }
        lines += m_file->remarks;
    }
    if (!m_isReading && m_body != nullptr) {
        const render::RestReading& reading = m_body->body.reading;
        lines += tr("%1 m tall, in %2 · %3")
                     .arg(fixed(static_cast<double>(reading.height), 2), unitName(reading.unit),
                          restName(reading.armsBelowLevel));
        if (reading.isInOtherUnit) {
            lines += tr("In metres the body would have no person's height: another unit was taken.");
        }
        if (reading.pointsBackwards) {
            lines += tr("The feet point backwards: left and right may be swapped.");
        }
    }
    const bool hasProblem = !m_isReading && !m_problem.isEmpty();
    if (hasProblem) {
        lines += QStringLiteral("▲ ") + m_problem;
    }
    m_state->setText(lines.join(QLatin1Char('\n')));
    setTextColour(*m_state, hasProblem ? theme().warning : theme().dim);
    const bool hasFile = !m_isReading && m_file != nullptr;
    for (QComboBox* each : {m_unit, m_heading, m_rest, m_size}) {
        each->setEnabled(hasFile);
    }
    m_table->setEnabled(hasFile);
    m_again->setVisible(hasProblem && m_file == nullptr);
    m_browse->setEnabled(!m_isReading);
    m_apply->setEnabled(!m_isReading && m_body != nullptr);
    m_mannequin->setEnabled(m_characters.hasOwn(who()));
}

void OwnCharacterDialog::accept() {
    if (m_body != nullptr && !m_isReading) {
        m_characters.dress(who(), m_file, choice(), m_body);
        QDialog::accept();
    }
}

} // namespace posewire::gui
