/* Opens a NanoScope file of force curves and checks its header against the stored bytes.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "read/bytes/bytes.h"
#include "read/nanoscope/nanoscope.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define SECTION_SCAN "Ciao scan list"
#define SECTION_FORCE "Ciao force list"
#define SECTION_BLOCK "Ciao force image list"
#define SECTION_IMAGE "Ciao image list"

/* Maximum number of samples of a segment. */
#define CURVE_SAMPLES_MAX ((size_t)10000000)

/* Full scale of a 16-bit converter, to which the volts per count of the header refer. */
static const double counts_max = 32768;

static wt_status fail_block(wt_error *err, const char *message, const char *expected)
{
    wt_fail(err, WT_E_CORRUPT, "%s", message);
    wt_error_place(err, "\\*" SECTION_BLOCK);
    wt_error_expected(err, "%s", expected);
    return WT_E_CORRUPT;
}

/* Returns integer i of a list such as "512 512"; 0 if it is absent or too large. */
static size_t list_integer(const char *text, size_t i)
{
    for (; text != NULL; i--) {
        char *end = NULL;
        const double value = strtod(text, &end);
        if (end == text)
            return 0;
        if (i == 0)
            return value >= 1 && value <= 1e15 ? (size_t)value : 0;
        text = end;
    }
    return 0;
}

static size_t header_integer(const nanoscope_file *f, size_t section, const char *key, size_t i)
{
    return list_integer(nanoscope_get(&f->header, section, key), i);
}

/* ---- number of curves and sample width ------------------------------------------------------- */

static size_t curve_samples(const nanoscope_file *f)
{
    return f->n_in + f->n_hold + f->n_out;
}

/* Samples that a curve occupies in the file. */
static size_t stored_samples(const nanoscope_file *f)
{
    return f->half > 0 ? 2 * f->half : curve_samples(f);
}

/* Tries a grid that the header names against the size of the block. The pixels of an image need not
 * be those of the curves. "Bytes/pixel" is 2 even where four bytes are stored. */
static bool try_grid(nanoscope_file *f, size_t columns, size_t rows, size_t bytes, unsigned *width)
{
    const size_t samps = curve_samples(f);
    if (columns == 0 || rows == 0 || bytes / samps / rows < columns)
        return false;
    for (unsigned w = 2; w <= 4; w += 2) {
        if (bytes != w * columns * rows * samps)
            continue;
        *width = w;
        f->n_planned = columns * rows;
        f->columns = f->n_planned > 1 ? (long)columns : 0;
        f->rows = f->n_planned > 1 ? (long)rows : 0;
        return true;
    }
    return false;
}

static bool find_grid(nanoscope_file *f, size_t bytes, unsigned *width)
{
    const size_t force = nanoscope_section(&f->header, SECTION_FORCE, 0);
    const size_t scan = nanoscope_section(&f->header, SECTION_SCAN, 0);
    const char *context = nanoscope_get(&f->header, 0, "Start context");
    const size_t side = header_integer(f, force, "force/line", 0);
    if (context != NULL && strcmp(context, "FOL") == 0)
        return try_grid(f, 1, 1, bytes, width);
    if (try_grid(f, side, side, bytes, width) ||
        try_grid(f, header_integer(f, scan, "Samps/line", 0), header_integer(f, scan, "Lines", 0),
                 bytes, width))
        return true;
    for (size_t i = 0;; i++) {
        const size_t image = nanoscope_section(&f->header, SECTION_IMAGE, i);
        if (image == SIZE_MAX)
            return try_grid(f, 1, 1, bytes, width);
        if (try_grid(f, header_integer(f, image, "Samps/line", 0),
                     header_integer(f, image, "Number of lines", 0), bytes, width))
            return true;
    }
}

/* Tries a single curve whose ramp was stopped: the block has room for two whole ways. */
static bool find_stopped_ramp(nanoscope_file *f, size_t section, size_t bytes, unsigned *width)
{
    const char *context = nanoscope_get(&f->header, 0, "Start context");
    const size_t w = header_integer(f, section, "Bytes/pixel", 0), half = w > 0 ? bytes / w / 2 : 0;
    if (context == NULL || strcmp(context, "FOL") != 0 || (w != 2 && w != 4) || f->n_hold > 0 ||
        bytes != 2 * w * half || half < f->n_in || half < f->n_out || half > CURVE_SAMPLES_MAX ||
        (f->n_channels > 0 && f->half != half))
        return false;
    *width = (unsigned)w;
    f->half = half;
    f->n_planned = 1;
    return true;
}

/* Sets the channel name from a text such as "[DeflectionError] "Deflection Error"": the part in
 * quotation marks. */
static void set_channel_name(const char *text, nanoscope_channel *c)
{
    const char *open = text != NULL ? strchr(text, '"') : NULL;
    const char *close = open != NULL ? strchr(open + 1, '"') : NULL;
    snprintf(c->name, sizeof c->name, "%.*s", close != NULL ? (int)(close - open - 1) : 0,
             close != NULL ? open + 1 : "");
    c->quantity = strncmp(c->name, "Defl", 4) == 0             ? WT_Q_DEFLECTION_VOLTAGE
                  : strncmp(c->name, "Height Sensor", 13) == 0 ? WT_Q_MEASURED_HEIGHT
                                                               : WT_Q_NONE;
}

static wt_status read_channel_block(nanoscope_file *f, size_t section, wt_error *err)
{
    nanoscope_channel c = {.width = 0};
    const nanoscope_value scale =
        nanoscope_parse_value(nanoscope_get(&f->header, section, "Z scale"));
    const size_t bytes = header_integer(f, section, "Data length", 0);
    const size_t n_in = header_integer(f, section, "Samps/line", 0);
    const size_t n_out = header_integer(f, section, "Samps/line", 1);
    const size_t before = f->n_planned;
    c.offset = header_integer(f, section, "Data offset", 0);
    set_channel_name(nanoscope_get(&f->header, section, "Image Data"), &c);
    const double soft = nanoscope_soft_scale(&f->header, scale.soft);
    c.scale = c.quantity == WT_Q_MEASURED_HEIGHT ? scale.step * soft : scale.step;
    if (f->n_in == 0) {
        f->n_in = n_in;
        f->n_out = n_out > 0 ? n_out : n_in;
    }
    if (n_in == 0 || n_in > CURVE_SAMPLES_MAX || n_out > CURVE_SAMPLES_MAX || bytes == 0 ||
        c.offset == 0)
        return fail_block(err, "the block of a channel is not described",
                          "Data offset, Data length and Samps/line");
    if (n_in != f->n_in || (n_out > 0 && n_out != f->n_out))
        return fail_block(err, "channels of different length", "the same Samps/line for all");
    if (c.quantity == WT_Q_DEFLECTION_VOLTAGE && !isfinite(soft))
        f->cantilever.sensitivity = (double)NAN;
    else if (c.quantity == WT_Q_DEFLECTION_VOLTAGE)
        f->cantilever.sensitivity = soft;
    if (!find_grid(f, bytes, &c.width) && !find_stopped_ramp(f, section, bytes, &c.width)) {
        wt_fail(err, WT_E_CORRUPT, "the size of a block agrees with no number of curves");
        wt_error_found(err, "%zu bytes for curves of %zu samples", bytes, curve_samples(f));
        wt_error_place(err, "\\*" SECTION_BLOCK ", Data length");
        wt_error_expected(err, "2 or 4 bytes for each sample of all curves");
        return WT_E_CORRUPT;
    }
    if (f->n_channels > 0 && f->n_planned != before)
        return fail_block(err, "channels of different numbers of curves",
                          "blocks of all channels for as many curves");
    if (!isfinite(c.scale))
        c.quantity = WT_Q_NONE;
    f->channels[f->n_channels++] = c;
    return WT_OK;
}

/* Warns of additional bytes. Measured files end with their last block. Inserted bytes shift the
 * data after them. */
static void check_file_end(const nanoscope_file *f, wt_log *log)
{
    static const char *const lists[] = {SECTION_BLOCK, SECTION_IMAGE};
    size_t end = 0;
    for (size_t k = 0; k < 2; k++)
        for (size_t i = 0, section;
             (section = nanoscope_section(&f->header, lists[k], i)) != SIZE_MAX; i++) {
            const size_t here = header_integer(f, section, "Data offset", 0) +
                                header_integer(f, section, "Data length", 0);
            end = here > end ? here : end;
        }
    if (f->length > end)
        wt_log_add(log, WT_WARNING, f->name, NULL,
                   "the file is %zu bytes longer than its header says: if they stand inside, "
                   "what is behind them is shifted; copy the file again from the instrument",
                   f->length - end);
}

/* Limits the number of curves to those that are complete, if a block exceeds the file. */
static wt_status limit_curves(nanoscope_file *f, wt_log *log, wt_error *err)
{
    f->n_curves = f->n_planned;
    check_file_end(f, log);
    for (size_t i = 0; i < f->n_channels; i++) {
        const nanoscope_channel *c = &f->channels[i];
        const size_t forward = c->offset < f->length ? f->length - c->offset : 0;
        const size_t whole_curves = forward / c->width / stored_samples(f);
        f->n_curves = whole_curves < f->n_curves ? whole_curves : f->n_curves;
    }
    if (f->n_curves == 0)
        return fail_block(err, "the file is cut off", "at least one curve");
    if (f->n_curves < f->n_planned)
        wt_log_add(log, WT_LOSS, f->name, NULL, "the file is cut off: %zu of %zu curves are there",
                   f->n_curves, f->n_planned);
    return WT_OK;
}

/* ---- motion of the piezo --------------------------------------------------------------------- */

/* Returns the first of these keys in the section of the block or of the ramp. */
static nanoscope_value find_ramp_value(const nanoscope_file *f, size_t block, size_t force)
{
    static const char *const keys[] = {"Ramp size", "Ramp size Zsweep", "Z scan size"};
    nanoscope_value v = nanoscope_parse_value(NULL);
    for (size_t k = 0; k < sizeof keys / sizeof *keys; k++) {
        v = nanoscope_parse_value(nanoscope_get(&f->header, block, keys[k]));
        if (!isfinite(v.value))
            v = nanoscope_parse_value(nanoscope_get(&f->header, force, keys[k]));
        if (v.value > 0)
            return v;
    }
    return v;
}

static void read_ramp_settings(nanoscope_file *f, size_t block)
{
    const size_t force = nanoscope_section(&f->header, SECTION_FORCE, 0);
    const nanoscope_value size = find_ramp_value(f, block, force);
    const double sensitivity = nanoscope_soft_scale(&f->header, size.soft);
    const double forward =
        force_positive_or_nan(nanoscope_number(&f->header, force, "Forward vel."));
    const double back = force_positive_or_nan(nanoscope_number(&f->header, force, "Reverse vel."));
    f->ramp = force_positive_or_nan(size.value * sensitivity);
    /* The velocities are in volts of the piezo per second. */
    f->time_in = size.value / forward;
    f->time_out = size.value / back;
    if (f->half > 0) {
        f->time_in *= (double)f->n_in / (double)f->half;
        f->time_out *= (double)f->n_out / (double)f->half;
    }
    f->time_hold = f->n_hold > 0 ? nanoscope_number(&f->header, force, "Hold Time") : 0;
    f->velocity_in = forward * sensitivity;
    f->velocity_out = back * sensitivity;
    const char *mode = nanoscope_get(&f->header, force, "Trigger mode");
    const nanoscope_value trigger =
        nanoscope_parse_value(nanoscope_get(&f->header, force, "Trig threshold Deflection"));
    f->trigger = mode != NULL && strcmp(mode, "Relative") == 0
                     ? force_positive_or_nan(trigger.value)
                     : (double)NAN;
}

/* Reads a PeakForce capture: one period of an oscillation with any phase. Its deepest point is at
 * "Sync Distance" of "Sample Points". This is known from other programs only. */
static void read_sinusoid(nanoscope_file *f)
{
    const size_t scan = nanoscope_section(&f->header, SECTION_SCAN, 0);
    const char *capture = nanoscope_get(&f->header, scan, "PeakForce Capture");
    const double amplitude = nanoscope_number(&f->header, scan, "Peak Force Amplitude");
    double sync = nanoscope_number(&f->header, scan, "Sync Distance QNM");
    const double points = nanoscope_number(&f->header, scan, "Sample Points");
    const double kilohertz = nanoscope_number(&f->header, scan, "PFT Freq");
    const double n = (double)curve_samples(f);
    if (isnan(sync))
        sync = nanoscope_number(&f->header, scan, "Sync Distance");
    if (capture == NULL || strcmp(capture, "Allow") != 0 || !(amplitude > 0) || !(points > 0) ||
        !(sync >= 0 && sync <= points) || f->n_hold > 0)
        return;
    f->sinusoid = true;
    f->shift = (size_t)lrint(sync / points * n) % curve_samples(f);
    f->ramp = 2e-9 * amplitude;
    const double period = force_positive_or_nan(1e-3 / kilohertz);
    f->time_in = period * (double)f->n_in / n;
    f->time_out = period * (double)f->n_out / n;
    f->velocity_in = f->velocity_out = f->trigger = (double)NAN;
}

/* Reads the distance of the grid points from "2000 nm" or "2 2 ~m". */
static void read_grid_pitch(nanoscope_file *f)
{
    const size_t scan = nanoscope_section(&f->header, SECTION_SCAN, 0);
    const char *text = nanoscope_get(&f->header, scan, "Scan Size");
    const char *unit = text != NULL ? strrchr(text, ' ') : NULL;
    double factor = 1e-6, offset = 0;
    f->pitch = (double)NAN;
    if (f->columns == 0 || unit == NULL ||
        (strcmp(unit + 1, "~m") != 0 &&
         wt_unit_to_si(unit + 1, WT_Q_LENGTH, &factor, &offset, NULL) != WT_OK))
        return;
    f->pitch = force_positive_or_nan(factor * nanoscope_number(&f->header, scan, "Scan Size") /
                                     (double)f->columns);
}

/* ---- counts ------------------------------------------------------------------------------------
 */

/* Returns the stored index of sample i in temporal order. */
static size_t stored_index(const nanoscope_file *f, size_t i)
{
    const size_t n = curve_samples(f);
    if (f->sinusoid)
        i = (i + f->shift + n - f->n_in) % n;
    return i < f->n_in ? f->n_in - 1 - i : f->half > 0 ? f->half + i - f->n_in : i;
}

wt_status nanoscope_read_curve(const nanoscope_file *f, const nanoscope_channel *channel,
                               size_t curve, const unsigned char **stored, wt_error *err)
{
    const size_t n = channel->width * stored_samples(f);
    return window_bytes(&f->windows[channel - f->channels], channel->offset + curve * n, n, stored,
                        err);
}

/* Checks that the samples behind those of a stopped ramp repeat one number. */
static wt_status check_stopped_ramp(const nanoscope_file *f, wt_log *log, wt_error *err)
{
    for (size_t i = 0; f->half > 0 && i < f->n_channels; i++) {
        const nanoscope_channel *const c = &f->channels[i];
        const unsigned char *stored = NULL;
        const wt_status status = nanoscope_read_curve(f, c, 0, &stored, err);
        if (status != WT_OK)
            return status;
        for (size_t k = 0; k < 2 * f->half; k++) {
            const size_t end = k < f->half ? f->half - 1 : 2 * f->half - 1;
            if (k % f->half >= (k < f->half ? f->n_in : f->n_out) &&
                memcmp(stored + c->width * k, stored + c->width * end, c->width) != 0)
                return fail_block(err, "the samples of a stopped ramp are not understood",
                                  "one number behind the last sample of each way");
        }
    }
    if (f->half > 0)
        wt_log_add(log, WT_NOTE, f->name, NULL,
                   "the ramp was stopped: %zu and %zu of %zu samples were measured", f->n_in,
                   f->n_out, f->half);
    return WT_OK;
}

double nanoscope_sample(const nanoscope_file *f, const nanoscope_channel *channel,
                        const unsigned char *stored, size_t i)
{
    const unsigned char *at = stored + channel->width * stored_index(f, i);
    const bool narrow = channel->width == 2;
    const double count = narrow ? (double)signed16(le16(at)) : (double)signed32(le32(at));
    return count == (narrow ? -counts_max : -0x1p31) ? (double)NAN : count;
}

/* Returns the valid count nearest to the beginning of the approach, or to its end; NaN if there is
 * none. */
static double edge_count(const nanoscope_file *f, const nanoscope_channel *c,
                         const unsigned char *stored, bool last)
{
    double count = (double)NAN;
    for (size_t i = 0; i < f->n_in && isnan(count); i++)
        count = nanoscope_sample(f, c, stored, last ? f->n_in - 1 - i : i);
    return count;
}

/* Finds the largest change of the signal over the approach of all curves [V]. The maximum suffices
 * to distinguish factors 1 and 256. */
static wt_status largest_rise(const nanoscope_file *f, const nanoscope_channel *c, double *rise,
                              double *largest, wt_error *err)
{
    for (size_t curve = 0; curve < f->n_curves; curve++) {
        const unsigned char *stored = NULL;
        const wt_status status = nanoscope_read_curve(f, c, curve, &stored, err);
        if (status != WT_OK)
            return status;
        const double end = c->scale * edge_count(f, c, stored, true);
        const double start = c->scale * edge_count(f, c, stored, false);
        *largest = fmax(*largest, fmax(fabs(start), fabs(end)));
        if (fabs(end - start) > fabs(*rise))
            *rise = end - start;
    }
    return WT_OK;
}

/* Corrects the scale. In force volumes of software 9.2 the 32-bit counts are 256 times those of
 * the header; in its single curves they are not. The trigger decides, else the range of the
 * converter. */
static wt_status check_scale(nanoscope_file *f, wt_log *log, wt_error *err)
{
    static const double times = 256, doubtful = 5;
    for (size_t i = 0; i < f->n_channels; i++) {
        nanoscope_channel *c = &f->channels[i];
        double rise = 0, largest = 0;
        if (c->quantity != WT_Q_DEFLECTION_VOLTAGE)
            continue;
        const wt_status status = largest_rise(f, c, &rise, &largest, err);
        if (status != WT_OK)
            return status;
        const double range = counts_max * c->scale;
        if (c->width == 4 &&
            (largest > range || (f->trigger > 0 && fabs(rise) > 16 * f->trigger))) {
            c->scale /= times;
            rise /= times;
            largest /= times;
            f->scaled = true;
            wt_log_add(log, WT_NOTE, f->name, c->name,
                       "counts are 256 times those that the header is for");
        }
        if (largest > range)
            return fail_block(err, "deflections are outside the range of the converter",
                              "counts that Z scale is for");
        if (f->trigger > 0 && !(rise > f->trigger / doubtful && rise < f->trigger * doubtful))
            wt_log_add(log, WT_WARNING, f->name, c->name,
                       "the deflection rises by %.3g V where the trigger was %.3g V: the scale "
                       "of the file is doubtful",
                       rise, f->trigger);
    }
    return WT_OK;
}

/* Sets the sign of the height sensors. The file does not state it; the height decreases over the
 * approach. */
static wt_status orient_sensor(nanoscope_file *f, wt_error *err)
{
    for (size_t i = 0; i < f->n_channels; i++) {
        nanoscope_channel *c = &f->channels[i];
        if (c->quantity != WT_Q_MEASURED_HEIGHT)
            continue;
        const unsigned char *stored = NULL;
        const wt_status status = nanoscope_read_curve(f, c, 0, &stored, err);
        if (status != WT_OK)
            return status;
        if (edge_count(f, c, stored, true) > edge_count(f, c, stored, false))
            c->scale = -c->scale;
        if (f->scaled)
            c->scale /= 256;
    }
    return WT_OK;
}

/* ---- opening -----------------------------------------------------------------------------------
 */

static wt_status read_channel_blocks(nanoscope_file *f, wt_error *err)
{
    const size_t force = nanoscope_section(&f->header, SECTION_FORCE, 0);
    const size_t first = nanoscope_section(&f->header, SECTION_BLOCK, 0);
    wt_status status = WT_OK;
    if (first == SIZE_MAX) {
        wt_fail(err, WT_E_EMPTY, "the file holds no force curve");
        wt_error_expected(err, "a section \"\\*" SECTION_BLOCK "\"");
        return WT_E_EMPTY;
    }
    f->n_hold = header_integer(f, force, "Hold Samples", 0);
    if (f->n_hold > CURVE_SAMPLES_MAX)
        return fail_block(err, "the hold is longer than any measurement",
                          "Hold Samples up to 10^7");
    for (size_t i = 0; i < NANOSCOPE_CHANNELS && status == WT_OK; i++) {
        const size_t section = nanoscope_section(&f->header, SECTION_BLOCK, i);
        if (section == SIZE_MAX)
            break;
        status = read_channel_block(f, section, err);
    }
    f->cantilever.spring_constant =
        force_positive_or_nan(nanoscope_number(&f->header, first, "Spring Constant"));
    return status;
}

wt_status nanoscope_file_open(wt_input *input, wt_log *log, nanoscope_file *f, wt_error *err)
{
    *f = (nanoscope_file){
        .name = wt_input_name(input),
        .cantilever = {.spring_constant = (double)NAN, .sensitivity = (double)NAN}};
    const unsigned char *bytes = NULL;
    size_t n = 0;
    bool whole = false;
    wt_status status = wt_input_size(input, &f->length, err);
    if (status == WT_OK)
        status = wt_input_peek(input, NANOSCOPE_HEADER_MAX, &bytes, &n, &whole, err);
    if (status == WT_OK && !nanoscope_is_header(bytes, n))
        status = fail_block(err, "damaged header", "\\*Force file list");
    if (status == WT_OK)
        status = nanoscope_header_read(bytes, n, &f->header, err);
    if (status == WT_OK)
        status = read_channel_blocks(f, err);
    if (status == WT_OK)
        status = windows_open(&f->windows, f->n_channels, input, err);
    if (status == WT_OK)
        status = limit_curves(f, log, err);
    if (status == WT_OK)
        status = check_stopped_ramp(f, log, err);
    if (status == WT_OK) {
        nanoscope_check_calibration(&f->header, f->name, log);
        read_ramp_settings(f, nanoscope_section(&f->header, SECTION_BLOCK, 0));
        read_sinusoid(f);
        read_grid_pitch(f);
        status = check_scale(f, log, err);
    }
    return status == WT_OK ? orient_sensor(f, err) : status;
}

void nanoscope_file_close(nanoscope_file *f)
{
    nanoscope_header_clear(&f->header);
    for (size_t i = 0; f->windows != NULL && i < f->n_channels; i++)
        window_close(&f->windows[i]);
    free(f->windows);
}
