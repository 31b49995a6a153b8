#include "label/lists/object_inspector.h"

#include <QLineEdit>
#include <QTest>

#include "ui/support/ui_test.h"

namespace eyrie::ui::object_inspector_test {

/// The inspector by itself: whose notes stand in it.
class ObjectInspectorTest : public QObject {
    Q_OBJECT

 private slots:
    void notesAreThoseOfTheObjectThatWasShownWhileTheyWereWritten() {
        ObjectInspector inspector;
        ObjectDetails first;
        first.id = 3;
        first.notes = QStringLiteral("white");
        ObjectDetails second;
        second.id = 5;
        second.notes = QStringLiteral("parked");
        QStringList kept;
        ObjectEdits edits;
        edits.set_notes = [&](int object, const QString& notes) {
            kept << QStringLiteral("%1 %2").arg(object).arg(notes);
            inspector.showObject(second);  // as labels do once they are stored: the other one is selected by then
        };
        inspector.setEdits(edits);
        inspector.showObject(first);
        inspector.notes().setCursorPosition(5);
        QTest::keyClicks(&inspector.notes(), QStringLiteral(" van"));
        inspector.showObject(second);  // by a click on its row in the timeline, which leaves the focus in the field
        QCOMPARE(kept, QStringList{QStringLiteral("3 white van")});
        QCOMPARE(inspector.notes().text(), QStringLiteral("parked"));
        inspector.showObject(std::nullopt);
        QCOMPARE(kept.size(), 1);  // nothing was written of the other one
    }

    void notesThatWereKeptAreNotWrittenAgain() {
        ObjectInspector inspector;
        ObjectDetails object;
        object.id = 3;
        QStringList kept;
        ObjectEdits edits;
        edits.set_notes = [&](int, const QString& notes) { kept << notes; };
        inspector.setEdits(edits);
        inspector.showObject(object);
        QTest::keyClicks(&inspector.notes(), QStringLiteral("van"));
        QTest::keyClick(&inspector.notes(), Qt::Key_Return);
        QCOMPARE(kept, QStringList{QStringLiteral("van")});
        inspector.showObject(std::nullopt);  // those of another video, which may have an object 3, too
        QCOMPARE(kept.size(), 1);
    }
};

}  // namespace eyrie::ui::object_inspector_test

EYRIE_UI_TEST(QApplication, object_inspector_test, ObjectInspectorTest)
#include "object_inspector_test.moc"
