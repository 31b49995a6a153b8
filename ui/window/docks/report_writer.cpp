#include "window/docks/report_writer.h"

#include <QAbstractTextDocumentLayout>
#include <QDir>
#include <QFile>
#include <QFileDialog>
#include <QFileInfo>
#include <QGuiApplication>
#include <QImage>
#include <QPageSize>
#include <QPainter>
#include <QPdfWriter>
#include <QScreen>
#include <QSettings>
#include <QSvgRenderer>
#include <QTextDocument>
#include <QThread>
#include <QUrl>
#include <future>

#include "core/error.h"
#include "core/time/utc_time.h"
#include "io/atomic_file.h"
#include "io/output_files.h"
#include "window/docks/report_pages.h"

namespace eyrie::ui {

namespace {

constexpr int kDotsPerInch = 144;  ///< of the page; pictures are drawn finer
constexpr double kMargin_mm = 15;
constexpr double kFigureScale = 3;
constexpr double kFooter_mm = 8;
constexpr double kPerInch_mm = 25.4;

QImage pictureOf(const std::string& svg) {
    QSvgRenderer renderer(QByteArray::fromStdString(svg));
    QImage image(renderer.defaultSize() * kFigureScale, QImage::Format_RGB32);
    image.fill(Qt::white);
    QPainter painter(&image);
    renderer.render(&painter);
    return image;
}

/// Pictures get this width on the page, and the height that belongs to it. Documents take attributes for px of the
/// screen and enlarge them as the page is finer.
void setWidth(QString& html, const QString& name, double width_mm, QSize size) {
    const QScreen* screen = QGuiApplication::primaryScreen();
    const double screen_dpi = screen != nullptr ? qRound(screen->logicalDotsPerInchY()) : 96;
    const double width = width_mm / kPerInch_mm * screen_dpi;
    const double height = size.width() > 0 ? width * size.height() / size.width() : width;
    html.replace(
        QStringLiteral("<img src=\"%1\">").arg(name),
        QStringLiteral("<img src=\"%1\" width=\"%2\" height=\"%3\">").arg(name).arg(qRound(width)).arg(qRound(height)));
}

/// All pages, each with its number below.
void print(QTextDocument& document, QPdfWriter& writer, const QString& title) {
    const double footer = kFooter_mm / kPerInch_mm * kDotsPerInch;
    const QSizeF page(writer.width(), writer.height() - footer);
    document.setDocumentMargin(0);
    document.setPageSize(page);
    keepTogether(document, page.height());
    QFont small = document.defaultFont();
    small.setPointSizeF(7);
    QPainter painter(&writer);
    const int pages = document.pageCount();
    for (int i = 0; i < pages; ++i) {
        if (i > 0) writer.newPage();
        const QRectF part(0, i * page.height(), page.width(), page.height());
        painter.save();
        painter.translate(0, -part.top());
        painter.setClipRect(part);
        QAbstractTextDocumentLayout::PaintContext context;
        context.clip = part;
        context.palette.setColor(QPalette::Text, Qt::black);
        document.documentLayout()->draw(&painter, context);
        painter.restore();
        painter.setFont(small);
        painter.setPen(QColor(90, 90, 90));
        const QRectF line(0, page.height(), page.width(), footer);
        painter.drawText(line, Qt::AlignLeft | Qt::AlignBottom, title);
        painter.drawText(line, Qt::AlignRight | Qt::AlignBottom,
                         QCoreApplication::translate("report", "page %1 of %2").arg(i + 1).arg(pages));
    }
}

[[noreturn]] void refuse(const QString& path, const QString& reason) {
    throw Error(ErrorKind::output,
                QStringLiteral("%1: cannot be written: %2. Choose another folder.").arg(path, reason).toStdString());
}

}  // namespace

namespace {

void writePdf(const std::filesystem::path& path, const ReportFile& report) {
    const QString name = QString::fromStdString(path.string());
    // Readers see a whole file or none.
    const QString part = QString::fromStdString(temporaryBeside(path).string());
    QFile file(part);
    if (!file.open(QIODevice::WriteOnly)) refuse(name, file.errorString());
    {
        QPdfWriter writer(&file);
        writer.setPageSize(QPageSize(QPageSize::A4));
        writer.setPageMargins(QMarginsF(kMargin_mm, kMargin_mm, kMargin_mm, kMargin_mm), QPageLayout::Millimeter);
        writer.setResolution(kDotsPerInch);
        writer.setCreator(QStringLiteral("Eyrie"));
        QTextDocument document;
        QString html = QString::fromStdString(report.html);
        for (const auto& [key, picture] : report.pictures) {
            const QString source = QString::fromStdString(key);
            const QImage image = picture.kind == ReportPicture::Kind::svg
                                     ? pictureOf(picture.bytes)
                                     : QImage::fromData(QByteArray::fromStdString(picture.bytes));
            document.addResource(QTextDocument::ImageResource, QUrl(source), image);
            setWidth(html, source, picture.width_mm, image.size());
        }
        QFont font(QStringLiteral("DejaVu Sans"));
        font.setPointSizeF(8.5);
        document.setDefaultFont(font);
        document.documentLayout()->setPaintDevice(&writer);
        document.setDefaultStyleSheet(QStringLiteral(
            "h1{font-size:16pt} h2{font-size:12pt;margin-top:14px;margin-bottom:4px} "
            "h2.chapter{page-break-before:always;margin-top:0} h3{font-size:9.5pt;margin-top:10px;margin-bottom:2px} "
            "table{border-collapse:collapse} "
            "td{font-size:8pt;padding:2px 8px 2px 0;border-bottom:1px solid #dddddd} "
            "table.chips td{vertical-align:middle} "
            "th{font-size:8pt;padding:2px 8px 2px 0;border-bottom:1px solid #666666}"));
        html.remove(html.indexOf(QStringLiteral("<style>")),
                    html.indexOf(QStringLiteral("</style>")) + 8 - html.indexOf(QStringLiteral("<style>")));
        document.setHtml(html);
        print(document, writer, document.metaInformation(QTextDocument::DocumentTitle));
    }
    file.flush();
    const bool complete = file.error() == QFileDevice::NoError && file.size() > 0;
    const QString reason = file.errorString();
    file.close();
    if (!complete) {
        QFile::remove(part);
        refuse(name, reason);
    }
    std::error_code error;
    std::filesystem::rename(part.toStdString(), path, error);
    if (error) {
        QFile::remove(part);
        refuse(name, QString::fromStdString(error.message()));
    }
}

}  // namespace

void writePdfReport(const std::filesystem::path& path, const ReportFile& report) {
    // Text documents lay themselves out with timers, which only threads of Qt have.
    std::packaged_task<void()> work([&] { writePdf(path, report); });
    std::future<void> written = work.get_future();
    const std::unique_ptr<QThread> thread(QThread::create([&] { work(); }));
    thread->start();
    thread->wait();
    written.get();
}

QString askForReportFile(QWidget& window, const QString& name) {
    QSettings settings;
    const QString folder = settings.value(QStringLiteral("report/folder"), QDir::homePath()).toString();
    QString chosen;
    QString path = QFileDialog::getSaveFileName(
        &window, QCoreApplication::translate("report", "Write a report"),
        QDir(folder).filePath(name + QStringLiteral(".html")),
        QCoreApplication::translate("report", "Web page, one file (*.html);;PDF (*.pdf)"), &chosen);
    if (path.isEmpty()) return {};
    if (QFileInfo(path).suffix().isEmpty())
        path += chosen.contains(QStringLiteral("pdf")) ? QStringLiteral(".pdf") : QStringLiteral(".html");
    settings.setValue(QStringLiteral("report/folder"), QFileInfo(path).path());
    return path;
}

void ReportWriter::write(WantedReport wanted) {
    if (working_) return;
    working_ = true;
    const auto work = [this, wanted = std::move(wanted)](const BackgroundTask& task) {
        const FileKind kind = kindOfReport(wanted.path);
        filesToReplace({{wanted.path, kind}}, wanted.read);
        std::unique_ptr<FrameSource> pixels;
        try {
            if (wanted.media) pixels = wanted.media->open({}, task.stop());
        } catch (const std::exception&) {
            // Without the video the report has no pictures.
        }
        const auto tell = [&](double share) { task.tell([this, share] { answers_.show_progress(share); }); };
        const ReportFile report = wanted.make(pixels.get(), tell, task.stop());
        if (task.stop().stop_requested()) {
            task.tell([this] {
                working_ = false;
                answers_.tell_stopped();
            });
            return;
        }
        if (kind == FileKind::pdf)
            writePdfReport(wanted.path, report);
        else
            writeHtmlReport(wanted.path, report);
        task.tell([this, path = wanted.path] {
            working_ = false;
            answers_.tell_written(path);
        });
    };
    writing_ = query_.post(work, [this](const QString& failure) {
        working_ = false;
        answers_.fail(failure);
    });
}

QString ReportWriter::workingText() {
    return QCoreApplication::translate("report", "A report is being written. Wait until it is done.");
}

void ReportWriter::write(const std::filesystem::path& path, const std::shared_ptr<const RunEvaluation>& evaluation,
                         std::optional<Media> media, const std::filesystem::path& project) {
    if (!evaluation) return;
    write({path,
           {project, evaluation->run.sequence.path},
           std::move(media),
           [evaluation](FrameSource* pixels, const std::function<void(double)>& progress, const std::stop_token& stop) {
               ReportOptions options;
               options.made_utc = nowUtc();
               return makeEvaluationReport(*evaluation, pixels, options, progress, stop);
           }});
}

}  // namespace eyrie::ui
