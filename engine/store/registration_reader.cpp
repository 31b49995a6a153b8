// The part of RunStore that reads how the frames were registered.
#include <SQLiteCpp/SQLiteCpp.h>

#include "store/rows.h"
#include "store/run_store.h"

namespace eyrie {

std::vector<Homography> RunStore::homographies(int run_id, FrameIndex from) const {
    return guarded(project_.path(), "reading the registration of run " + std::to_string(run_id), [&] {
        SQLite::Statement statement(
            project_.database(),
            "SELECT from_frame, to_frame, h00, h01, h02, h10, h11, h12, h20, h21, h22, inliers, "
            "rms_px FROM frame WHERE run_id = ? AND frame >= ? ORDER BY frame");
        statement.bind(1, run_id);
        statement.bind(2, from);
        std::vector<Homography> homographies;
        while (statement.executeStep()) {
            RowReader row(statement);
            Homography homography;
            homography.from_frame = row.integer();
            homography.to_frame = row.integer();
            for (double& element : homography.matrix.val) element = row.real();
            homography.inliers = row.integer();
            homography.rms_px = row.real();
            homographies.push_back(homography);
        }
        return homographies;
    });
}

std::vector<Registration> RunStore::registrations(int run_id) const {
    std::vector<Homography> maps = homographies(run_id);
    return guarded(project_.path(), "reading the registration of run " + std::to_string(run_id), [&] {
        SQLite::Statement statement(project_.database(),
                                    "SELECT registration_state, reason FROM frame WHERE run_id = ? ORDER BY frame");
        statement.bind(1, run_id);
        std::vector<Registration> registrations;
        // A run that works may have come further meanwhile.
        while (registrations.size() < maps.size() && statement.executeStep()) {
            RowReader row(statement);
            Registration registration;
            registration.state = row.word(stored::kRegistrationStates);
            registration.reason = row.text();
            registration.current_from_previous = maps[registrations.size()];
            registrations.push_back(std::move(registration));
        }
        return registrations;
    });
}

}  // namespace eyrie
