/* Cross-section of a wear track from profiles across it.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "job/height_input.h"
#include "record/record.h"

#include <math.h>
#include <stdlib.h>

static wt_status find_track(const wt_image *image, wt_track *track, wt_error *err)
{
    const size_t n = image->n_columns;
    double *const x = wt_alloc(n, sizeof *x);
    double *const z = wt_alloc(n, sizeof *z);
    size_t k = 0;
    for (size_t i = 0; i < n; i++)
        if (!isnan(image->values[i])) {
            x[k] = image->x_min + image->width * (double)i / (double)(n - 1);
            z[k++] = image->values[i];
        }
    const wt_status status = wt_track_find(x, z, k, track, err);
    free(x);
    free(z);
    return status;
}

typedef struct profile_areas {
    const wt_job *work;
    record_group areas;
} profile_areas;

static wt_status measure_profile(void *user, flow_file *file, size_t i, wt_error *err)
{
    profile_areas *const to = user;
    (void)i;
    wt_image image = {.values = NULL};
    wt_track track = {.found = false};
    wt_status status = flow_heights_read(file, NULL, true, "profile", to->work, &image, err);
    if (status == WT_OK && image.n_rows > 1) {
        status = wt_fail(err, WT_E_ARG, "a height map, and the track is measured across it");
        wt_error_advice(err, "export profiles across the track, a file each");
    }
    if (status == WT_OK)
        status = find_track(&image, &track, err);
    wt_image_clear(&image);
    if (status != WT_OK)
        return status;
    if (!track.found) {
        wt_fail(err, WT_E_EMPTY, "no track in the profile");
        wt_error_expected(err, "heights in its middle that lie deeper than the scatter of its "
                               "outer quarters");
        wt_error_advice(err, "measure across the whole track, with as much beside it");
        return WT_E_EMPTY;
    }
    record_group_add(&to->areas, track.area);
    if (track.ridges > track.area.value)
        wt_log_add(to->work->log, WT_WARNING, file->name, NULL,
                   "more stands above the surface beside the track than is missing in it: "
                   "material was pushed aside or transferred, and its volume is no wear");
    return WT_OK;
}

wt_status wear_profile_area(const wt_record_job *job, const wt_job *work, wt_estimate *area,
                            wt_error *err)
{
    wt_file_set set = job->profile_set != NULL ? *job->profile_set : job->sets[0];
    set.patterns = &job->profile;
    set.n_patterns = 1;
    if (job->profile_set == NULL)
        set.read.format = NULL; /* that of the records does not apply */
    flow_files files = {NULL, 0, NULL};
    profile_areas found = {.work = work};
    size_t n_failed = 0;
    wt_status status = flow_files_list(&set, 1, work, &files, err);
    if (status == WT_OK)
        status = flow_files_process(&files, work, measure_profile, &found, &n_failed, err);
    if (status == WT_OK && !(found.areas.n > 0)) {
        status = wt_fail(err, WT_E_EMPTY, "no profile shows the track");
        flow_error_add_files(&files, n_failed, err);
    }
    flow_files_clear(&files);
    if (status == WT_OK)
        *area = record_group_mean(&found.areas, "m^2");
    return status;
}
