/* The job of measured surfaces: converts height maps and profiles to one power spectrum.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/number.h"
#include "core/base/param.h"
#include "job/conditioning.h"
#include "job/cost.h"
#include "job/inputs.h"
#include "surface/numerics/surface_analysis.h"
#include "surface/surface.h"

#include <math.h>
#include <stdlib.h>

/* Smallest amplitude of an anisotropy that causes a warning. Friction changes by a third to a half
 * of it: the mean of cos 2 phi with the weight cos(phi)^(1 + n), where n = 0 to 1 is the slope of
 * ln E''. Here that is 3 to 5 %. */
static const double least_anisotropy = 0.1;
/* Share of filled heights that causes a warning. They have no short waves, so C of short waves is
 * too low by about this share, half of what aliased waves add at the end of the range. */
static const double missing_share_limit = 0.01;

wt_topography_job wt_topography_job_defaults(void)
{
    return (wt_topography_job){
        .options = wt_surface_options_defaults(), .end = (double)NAN, .end_slope = (double)NAN};
}

static const wt_param rows[] = {
    {PARAM_CHOICE_OF("form", wt_topography_job, options.form, "mean|plane|quadratic"),
     .help = "form of a scan that is taken off by least squares; of a profile the same of one "
             "variable"},
    {PARAM_CHOICE_OF("window", wt_topography_job, options.window, "hann|welch|none"),
     .help = "window before the transform; none is for surfaces that go on beyond their edges"},
    {PARAM_CHOICE_OF("scan-lines", wt_topography_job, scan_lines, "mend|keep"),
     .help = "what happens to offsets of scan lines and to scars: mend removes them, keep only "
             "names them"},
    {PARAM("tip-radius", wt_topography_job, options.tip_radius, WT_Q_LENGTH, ABOVE(0)),
     .value = "R", .unset = "",
     .help =
         SUCH_AS("radius of the tip that scanned, ", "10nm",
                 ": the reliable range ends where peaks are as sharp as half of its curvature")},
    {PARAM_TEXT_OF("image", wt_topography_job, image), .value = "NAME",
     .unset = "the first image of heights", .flags = PARAM_NO_CASE,
     .help = "which image of a file: a part of its name, such as backward"},
    {PARAM("end", wt_topography_job, end, WT_Q_WAVENUMBER, ABOVE(0)), .value = "Q",
     .unset = "the end of the reliable range",
     .help = SUCH_AS("largest wavenumber of the spectrum, ", "1e8rad/m",
                     "; beyond the reliable range it follows its self-affine law")},
    {PARAM("end-slope", wt_topography_job, end_slope, WT_Q_NONE, ABOVE(0)), .value = "X",
     .unset = "",
     .help =
         SUCH_AS("end it where the rms slope reaches this, ", "1.3", ", by its law if it must be")},
    {PARAM_FLAG_OF("heights", wt_topography_job, heights), .flags = PARAM_NO_CASE,
     .help = "the tables height_map and height_profile, too: heights less their form, thinned, of "
             "which weartrack report makes figures"},
};
PARAM_TABLE(wt_topography_job_params, wt_topography_job, rows, wt_topography_job_defaults, NO_PARTS)

/* ---- scans ----------------------------------------------------------------------------------- */

/* Removes the artefacts of the scanner, and says what was found. */
static void condition_scan(const wt_topography_job *job, const wt_job *work, const char *file,
                           double *z, wt_height_map *map)
{
    const bool mend = job->scan_lines == WT_SCAN_LINES_MEND;
    const char *const keep = mend ? "--scan-lines keep" : NULL;
    const scan_line_faults found = surface_scan_lines(z, map, mend);
    if (found.scars > 0)
        wt_log_action(
            work->log, WT_WARNING, mend ? WT_CORRECTED : WT_IMPLAUSIBLE, found.scars, keep, file,
            NULL,
            "scars: %zu parts of scan lines stand out from the lines before and behind them%s",
            found.scars,
            mend ? "; they are replaced by the mean of these lines (--scan-lines keep "
                   "leaves them)"
                 : " and raise the spectrum");
    if (found.offsets > 0)
        wt_log_action(
            work->log, WT_WARNING, mend ? WT_CORRECTED : WT_IMPLAUSIBLE, 0, keep, file, NULL,
            "the scan lines have random offsets of %.3g nm (standard deviation)%s",
            1e9 * found.offsets,
            mend ? "; each line loses its mean, and waves across the lines are left out of "
                   "the spectrum (--scan-lines keep leaves the offsets)"
                 : ", which raise the spectrum");
    else if (found.suspected)
        wt_log_action(
            work->log, WT_WARNING, WT_IMPLAUSIBLE, 0, NULL, file, NULL,
            "adjacent scan lines differ more than adjacent columns do: a texture along the "
            "lines, or a drift of the scanner, which raises the spectrum; scan the surface "
            "again at 90 degrees to distinguish them");
}

/* Measures one of the files. */
static wt_status measure_scan(const wt_topography_job *job, const wt_job *work, flow_file *file,
                              size_t n_files, surface_scan *to, wt_error *err)
{
    wt_image image = {.values = NULL};
    wt_status status = flow_heights_read(file, job->image, true, "topography", work, &image, err);
    if (status == WT_OK)
        status = flow_check_copy(
            file, flow_hash_samples(0, image.values, image.n_columns * image.n_rows), work);
    if (status != WT_OK) {
        wt_image_clear(&image);
        return status;
    }
    *to = (surface_scan){.name = file->name, .map = wt_image_height_map(&image)};
    snprintf(to->image, sizeof to->image, "%s", image.name);
    condition_scan(job, work, file->name, image.values, &to->map);
    status = wt_surface_analyse(&to->map, &job->options, &to->heights, &to->spectrum, err);
    if (status == WT_OK && job->heights) {
        status = surface_view_create(&to->map, job->options.form, n_files, &to->view, err);
        if (status != WT_OK)
            wt_surface_spectrum_clear(&to->spectrum);
    }
    if (status != WT_OK)
        wt_error_file(err, file->name);
    wt_image_clear(&image);
    to->map.z = NULL;
    if (status != WT_OK)
        return status;
    to->missing_share = (double)to->heights.missing / (double)to->heights.n;
    to->directions = wt_surface_anisotropy_fit(&to->spectrum, 2);
    if (to->missing_share > missing_share_limit)
        wt_log_add(work->log, WT_WARNING, file->name, NULL,
                   "%.2g %% of the heights are missing; they are filled smoothly, so that "
                   "short waves are too low there",
                   100 * to->missing_share);
    return WT_OK;
}

static wt_status measure_scans(const wt_topography_job *job, const wt_job *work,
                               const flow_files *files, surface_scan *scans, size_t *n,
                               wt_error *err)
{
    wt_status status = WT_OK;
    size_t n_failed = 0;
    for (size_t i = 0; status == WT_OK && i < files->n; i++) {
        wt_error failure = WT_ERROR_INIT;
        status = measure_scan(job, work, &files->file[i], files->n, &scans[*n], &failure);
        if (status == WT_OK) {
            (*n)++;
        } else if (flow_skip_file(work, &files->file[i], &failure)) {
            status = WT_OK;
        } else {
            n_failed++;
            status = wt_job_add_failure(work, files->file[i].name, status, &failure, err);
        }
    }
    if (status == WT_OK && *n == 0) {
        status = wt_fail(err, WT_E_EMPTY, "no file has heights of a surface");
        flow_error_add_files(files, n_failed, err);
    }
    return status;
}

/* ---- combined spectrum ----------------------------------------------------------------------- */

static void warn_profiles(const surface_result *w, const wt_job *work)
{
    if (w->n_profiles > 0 && isnan(w->directions.amplitude))
        wt_log_add(work->log, WT_WARNING, NULL, NULL,
                   "the spectrum of profiles assumes a surface that is the same in all "
                   "directions; a height map would test it");
    else if (w->n_profiles > 0 && surface_is_anisotropic(&w->directions))
        wt_log_add(work->log, WT_WARNING, NULL, NULL,
                   "the spectrum of profiles assumes a surface that is the same in all "
                   "directions, which it is not by the height maps");
    if (surface_profiles_disagree(w))
        wt_log_add(work->log, WT_WARNING, NULL, NULL,
                   "the profiles and the height maps disagree: where both have data, the "
                   "density by the profiles is %.2g of that by the maps (95 %%: %s); check "
                   "that they are of one surface, and leave out those that are not",
                   w->profiles_ratio.value,
                   format_range(w->profiles_ratio.low, w->profiles_ratio.high, 2).text);
}

static void warn_surface(const surface_result *w, size_t n, const wt_job *work)
{
    warn_profiles(w, work);
    if (n == 1)
        wt_log_add(work->log, WT_WARNING, NULL, NULL,
                   "one scan: the scatter between places of the surface is not known, and no "
                   "error contains it; scan several places");
    if (w->directions.amplitude > least_anisotropy && surface_is_anisotropic(&w->directions))
        wt_log_add(work->log, WT_WARNING, NULL, NULL,
                   "the surface is not the same in all directions: the density varies by %.0f "
                   "%% about its mean, which is reported; friction is computed with the mean",
                   100 * w->directions.amplitude);
    /* a self-affine surface has exponents of 0 to 1 (Mandelbrot, Phys. Scr. 32 (1985) 257) */
    if (w->law.found && (w->law.hurst.low > 1 || w->law.hurst.high < 0))
        wt_log_add(work->log, WT_WARNING, NULL, NULL,
                   "the Hurst exponent, %.3g, is outside 0 to 1 by more than its error: %s",
                   w->law.hurst.value,
                   w->law.hurst.low > 1
                       ? "short waves are too low, as a blunt tip or a filter leaves them; "
                         "check whether the heights were filtered, or scan with a sharper tip"
                       : "short waves are too high, as noise of the height leaves them; scan "
                         "more slowly, or combine several sizes");
}

wt_status wt_topography_compute(const wt_topography_job *job, const wt_job *work,
                                wt_topography_tables *tables, wt_error *err)
{
    if (job == NULL || work == NULL || tables == NULL)
        return wt_fail(err, WT_E_ARG, "no job of a surface");
    flow_files files = {0};
    surface_result whole = {.steep = (double)NAN};
    surface_scan *scans = NULL;
    size_t n = 0;
    wt_status status = param_check(wt_topography_job_params(), job, err);
    if (status == WT_OK && !isnan(job->end) && !isnan(job->end_slope))
        status = wt_fail(err, WT_E_ARG, "end and end-slope: the spectrum has one end");
    if (status == WT_OK)
        status = flow_files_list(job->sets, job->n_sets, work, &files, err);
    if (status == WT_OK) {
        scans = wt_alloc(files.n, sizeof *scans);
        status = measure_scans(job, work, &files, scans, &n, err);
    }
    if (status == WT_OK)
        status = surface_join_scans(scans, n, &whole, err);
    if (status == WT_OK) {
        whole.law = wt_self_affine_fit(&whole.spectrum);
        whole.directions = wt_surface_anisotropy_fit(surface_directional_spectrum(&whole), 2);
        whole.fourth = wt_surface_anisotropy_fit(surface_directional_spectrum(&whole), 4);
        warn_surface(&whole, n, work);
        status = surface_find_cutoff(job, work, &whole, err);
    }
    if (status == WT_OK)
        status =
            surface_tables_make(wt_topography_job_params(), job, scans, n, &whole, tables, err);
    cost_report(work, (cost_summary){.items = (double)n, .number = whole.rms_height});
    for (size_t i = 0; i < n; i++) {
        wt_surface_spectrum_clear(&scans[i].spectrum);
        surface_view_clear(&scans[i].view);
    }
    free(scans);
    surface_knots_clear(&whole.knots);
    wt_surface_spectrum_clear(&whole.spectrum);
    wt_surface_spectrum_clear(&whole.maps);
    flow_files_clear(&files);
    return status;
}
