/* Reads a segment of a JPK curve: its header with inherited keys, and its channels.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/number.h"
#include "read/jpk/jpk.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Finds a property that files of version 0 store below "data.". */
static const char *find_versioned_property(const property_list *properties, const char *prefix,
                                           const char *key)
{
    char longer[128];
    snprintf(longer, sizeof longer, "data.%s", key);
    const char *text = properties_find(properties, prefix, longer);
    return text != NULL ? text : properties_find(properties, prefix, key);
}

static wt_status fail_unsupported(wt_error *err, const char *what, const char *found)
{
    wt_fail(err, WT_E_UNSUPPORTED, "%s is not supported", what);
    wt_error_found(err, "%s", found != NULL ? found : "nothing");
    return WT_E_UNSUPPORTED;
}

typedef struct encoding_name {
    const char *name;
    sample_type type;
} encoding_name;

static bool find_encoding(const encoding_name names[], size_t n, const char *name,
                          sample_type *encoding)
{
    for (size_t i = 0; i < n; i++) {
        if (strcmp(names[i].name, name) != 0)
            continue;
        *encoding = names[i].type;
        return true;
    }
    return false;
}

static wt_status read_encoding(const property_list *properties, const char *prefix, jpk_lcd *lcd,
                               wt_error *err)
{
    static const encoding_name types[] = {
        {"float-data", SAMPLE_FLOAT32}, {"memory-float-data", SAMPLE_FLOAT32},
        {"float", SAMPLE_FLOAT32},      {"double-data", SAMPLE_FLOAT64},
        {"double", SAMPLE_FLOAT64},     {"memory-double-data", SAMPLE_FLOAT64}};
    static const encoding_name encoders[] = {
        {"signedshort", SAMPLE_INT16},      {"signedshort-limited", SAMPLE_INT16},
        {"unsignedshort", SAMPLE_UINT16},   {"unsignedshort-limited", SAMPLE_UINT16},
        {"signedinteger", SAMPLE_INT32},    {"signedinteger-limited", SAMPLE_INT32},
        {"unsignedinteger", SAMPLE_UINT32}, {"unsignedinteger-limited", SAMPLE_UINT32}};
    const char *type = find_versioned_property(properties, prefix, "type");
    const char *encoder = find_versioned_property(properties, prefix, "encoder.type");
    if (type == NULL)
        return fail_unsupported(err, "channel without a data type", type);
    lcd->raster = strcmp(type, "raster-data") == 0;
    if (lcd->raster || find_encoding(types, sizeof types / sizeof *types, type, &lcd->encoding))
        return WT_OK;
    if (encoder == NULL)
        return fail_unsupported(err, "channel data type without encoder", type);
    if (!find_encoding(encoders, sizeof encoders / sizeof *encoders, encoder, &lcd->encoding))
        return fail_unsupported(err, "channel encoder", encoder);
    return WT_OK;
}

static bool copy_bounded(char *to, size_t size, const char *from)
{
    size_t n = from == NULL ? 0 : strlen(from);
    if (n >= size)
        return false;
    memcpy(to, from == NULL ? "" : from, n);
    to[n] = '\0';
    return true;
}

/* Reads the keys "….scaling.": y = multiplier x + offset. */
static wt_status read_scaling(const property_list *properties, const char *prefix,
                              force_linear *scaling, wt_error *err)
{
    const char *style = properties_find(properties, prefix, "scaling.style");
    if (style != NULL && strcmp(style, "offsetmultiplier") != 0)
        return fail_unsupported(err, "scaling style", style);
    scaling->multiplier = properties_number(properties, prefix, "scaling.multiplier");
    scaling->offset = properties_number(properties, prefix, "scaling.offset");
    if (isnan(scaling->multiplier) || isnan(scaling->offset)) {
        wt_fail(err, WT_E_CORRUPT, "scaling without multiplier or offset");
        wt_error_found(err, "%sscaling", prefix);
        return WT_E_CORRUPT;
    }
    return WT_OK;
}

static wt_status read_encoder(const property_list *properties, const char *prefix, jpk_lcd *lcd,
                              wt_error *err)
{
    static const char *const prefixes[] = {"encoder.", "data.encoder."};
    char key[192];
    lcd->encoder = (force_linear){1, 0};
    const char *unit = properties_find(properties, prefix, "unit.unit");
    for (size_t i = 0; i < 2; i++) {
        snprintf(key, sizeof key, "%s%s", prefix, prefixes[i]);
        if (properties_find(properties, key, "scaling.multiplier") == NULL)
            continue;
        wt_status status = read_scaling(properties, key, &lcd->encoder, err);
        if (status != WT_OK)
            return status;
        const char *own = properties_find(properties, key, "scaling.unit.unit");
        unit = own != NULL ? own : unit;
        break;
    }
    if (!copy_bounded(lcd->base_unit, sizeof lcd->base_unit, unit))
        return fail_unsupported(err, "unit of a channel", unit);
    return WT_OK;
}

/* Reads a calibration slot. A slot that the file does not define is skipped. */
static wt_status read_slot(const property_list *properties, const char *prefix, const char *name,
                           jpk_lcd *lcd, wt_error *err)
{
    char key[192 + JPK_NAME];
    snprintf(key, sizeof key, "%sconversion-set.conversion.%s.", prefix, name);
    const char *defined = properties_find(properties, key, "defined");
    if (defined == NULL || strcmp(defined, "true") != 0)
        return WT_OK;
    if (lcd->n_slots == JPK_SLOTS)
        return fail_unsupported(err, "channel with so many calibration slots", name);
    jpk_slot *slot = &lcd->slots[lcd->n_slots];
    const char *base = properties_find(properties, key, "base-calibration-slot");
    const char *unit = properties_find(properties, key, "scaling.unit.unit");
    if (!copy_bounded(slot->name, sizeof slot->name, name) ||
        !copy_bounded(slot->base, sizeof slot->base, base) ||
        !copy_bounded(slot->unit, sizeof slot->unit, unit))
        return fail_unsupported(err, "calibration slot", name);
    wt_status status = read_scaling(properties, key, &slot->scaling, err);
    if (status == WT_OK)
        lcd->n_slots++;
    return status;
}

/* Reads the block from keys that start with `prefix`, such as "lcd-info.1.". */
static wt_status jpk_lcd_read(const property_list *properties, const char *prefix, jpk_lcd *lcd,
                              wt_error *err)
{
    *lcd = (jpk_lcd){0};
    wt_status status = read_encoding(properties, prefix, lcd, err);
    if (status == WT_OK)
        status = read_encoder(properties, prefix, lcd, err);
    if (status != WT_OK)
        return status;
    const char *base = properties_find(properties, prefix, "conversion-set.conversions.base");
    const char *preferred =
        properties_find(properties, prefix, "conversion-set.conversions.default");
    if (!copy_bounded(lcd->base, sizeof lcd->base, base) ||
        !copy_bounded(lcd->preferred, sizeof lcd->preferred, preferred != NULL ? preferred : base))
        return fail_unsupported(err, "calibration slot", base);
    const char *list = properties_find(properties, prefix, "conversion-set.conversions.list");
    char name[JPK_NAME];
    while (status == WT_OK && property_next_token(&list, name, sizeof name))
        status = read_slot(properties, prefix, name, lcd, err);
    return status;
}

const jpk_slot *jpk_lcd_slot(const jpk_lcd *lcd, const char *name)
{
    for (size_t i = 0; i < lcd->n_slots; i++)
        if (strcmp(lcd->slots[i].name, name) == 0)
            return &lcd->slots[i];
    return NULL;
}

bool jpk_lcd_chain(const jpk_lcd *lcd, const char *slot, force_linear *chain)
{
    force_linear total = {1, 0};
    /* From the requested slot down to the base. More steps than slots mean a cycle. */
    for (size_t step = 0; step <= lcd->n_slots; step++) {
        if (strcmp(slot, lcd->base) == 0) {
            *chain = total;
            return true;
        }
        const jpk_slot *s = jpk_lcd_slot(lcd, slot);
        if (s == NULL)
            return false;
        total.offset += total.multiplier * s->scaling.offset;
        total.multiplier *= s->scaling.multiplier;
        slot = s->base;
    }
    return false;
}

/* Parses the number N of a key "….*=N"; false for anything else. */
static bool parse_reference(const char *text, long *number)
{
    char *end = NULL;
    if (text == NULL || *text < '0' || *text > '9')
        return false;
    errno = 0;
    *number = strtol(text, &end, 10);
    return *end == '\0' && errno == 0;
}

/* Returns a property of the segment header, or of the shared header to which it refers. */
static const char *find_segment_property(const jpk_file *file, const jpk_segment *segment,
                                         const char *key)
{
    const char *stated = properties_find(&segment->header, "force-segment-header.", key);
    if (stated != NULL)
        return stated;
    long n = 0;
    if (!parse_reference(
            properties_get(&segment->header, "force-segment-header.force-segment-header-info.*"),
            &n))
        return NULL;
    char prefix[64];
    snprintf(prefix, sizeof prefix, "force-segment-header-info.%ld.", n);
    return properties_find(&file->shared, prefix, key);
}

/* Returns a setting of the user. Newer files store it below "settings.segment-settings.". */
static const char *find_setting(const jpk_file *file, const jpk_segment *segment, const char *name)
{
    char key[96];
    snprintf(key, sizeof key, "settings.segment-settings.%s", name);
    const char *text = find_segment_property(file, segment, key);
    snprintf(key, sizeof key, "settings.%s", name);
    return text != NULL ? text : find_segment_property(file, segment, key);
}

static wt_segment_kind segment_kind_from_style(const char *style, const char *type)
{
    if (strcmp(style, "extend") == 0)
        return WT_SEGMENT_APPROACH;
    if (strcmp(style, "retract") == 0)
        return WT_SEGMENT_RETRACT;
    if (strstr(style, "modulation") != NULL || (type != NULL && strstr(type, "modulation") != NULL))
        return WT_SEGMENT_MODULATION;
    return strcmp(style, "pause") == 0 ? WT_SEGMENT_DWELL : WT_SEGMENT_OTHER;
}

static void read_settings(const jpk_file *file, jpk_segment *segment)
{
    const char *style = find_setting(file, segment, "style");
    const double duration = parse_number_or_nan(find_segment_property(file, segment, "duration"));
    const double start = parse_number_or_nan(find_setting(file, segment, "z-start"));
    const double end = parse_number_or_nan(find_setting(file, segment, "z-end"));
    const double time = parse_number_or_nan(find_setting(file, segment, "duration"));
    snprintf(segment->style, sizeof segment->style, "%s", style != NULL ? style : "");
    segment->kind = segment_kind_from_style(
        segment->style, find_segment_property(file, segment, "settings.segment-settings.type"));
    const bool approach = segment->kind == WT_SEGMENT_APPROACH;
    const bool is_ramp = approach || segment->kind == WT_SEGMENT_RETRACT;
    segment->duration = duration >= 0 ? duration : (double)NAN;
    segment->velocity = is_ramp && time > 0 ? fabs(start - end) / time : (double)NAN;
    segment->frequency = segment->kind == WT_SEGMENT_MODULATION
                             ? parse_number_or_nan(find_setting(file, segment, "frequency"))
                             : (double)NAN;
    segment->setpoint_voltage =
        approach ? parse_number_or_nan(find_setting(file, segment, "setpoint")) : (double)NAN;
}

static wt_status find_shared_lcd(jpk_file *file, long id, const jpk_lcd **lcd, wt_error *err)
{
    for (size_t i = 0; i < file->n_lcds; i++) {
        if (file->lcds[i].id == id) {
            *lcd = &file->lcds[i];
            return WT_OK;
        }
    }
    if (file->shared.n == 0) {
        wt_fail(err, WT_E_CORRUPT, "shared-data/header.properties is missing");
        wt_error_advice(err, "without it the channels cannot be converted");
        return WT_E_CORRUPT;
    }
    char prefix[64];
    jpk_lcd found;
    snprintf(prefix, sizeof prefix, "lcd-info.%ld.", id);
    wt_status status = jpk_lcd_read(&file->shared, prefix, &found, err);
    if (status != WT_OK)
        return status;
    file->lcds = wt_realloc(file->lcds, file->n_lcds + 1, sizeof *file->lcds);
    found.id = id;
    file->lcds[file->n_lcds] = found;
    *lcd = &file->lcds[file->n_lcds++];
    return WT_OK;
}

static wt_status read_lcd(jpk_file *file, const jpk_segment *segment, const char *prefix,
                          jpk_lcd *lcd, wt_error *err)
{
    const char *text = properties_find(&segment->header, prefix, "lcd-info.*");
    long id = 0;
    if (text == NULL)
        return jpk_lcd_read(&segment->header, prefix, lcd, err);
    if (!parse_reference(text, &id)) {
        wt_fail(err, WT_E_CORRUPT, "reference to shared data is not a number");
        wt_error_found(err, "%slcd-info.*=%s", prefix, text);
        return WT_E_CORRUPT;
    }
    const jpk_lcd *shared = NULL;
    wt_status status = find_shared_lcd(file, id, &shared, err);
    if (status == WT_OK)
        *lcd = *shared;
    return status;
}

/* Finds the data file and the number of complete samples in it. `folder` ends in '/'. */
static wt_status find_channel_data(const jpk_file *file, const jpk_segment *segment,
                                   const char *prefix, const char *folder, jpk_channel *channel,
                                   wt_error *err)
{
    char name[512];
    double announced = properties_number(&segment->header, prefix, "data.num-points");
    size_t n = announced >= 0 && announced < 4e9 ? (size_t)announced : 0;
    if (channel->lcd.raster) {
        double start = properties_number(&segment->header, prefix, "data.start");
        double step = properties_number(&segment->header, prefix, "data.step");
        channel->n_points = n;
        channel->raster = (force_linear){step, start};
        if (isnan(start) || isnan(step)) {
            channel->understood = false;
            snprintf(channel->problem, sizeof channel->problem,
                     "raster without data.start and data.step");
        }
        return WT_OK;
    }
    const char *path = properties_find(&segment->header, prefix, "data.file.name");
    int length = snprintf(name, sizeof name, "%s%s", folder, path != NULL ? path : "");
    if (path == NULL || length < 0 || (size_t)length >= sizeof name ||
        !archive_find(file->archive, name, &channel->entry)) {
        if (path != NULL)
            wt_log_add(file->log, WT_WARNING, file->name, name,
                       "the header names these samples, but they are not in the file");
        return WT_OK;
    }
    size_t size = 0;
    wt_status status = archive_size(file->archive, channel->entry, &size, err);
    if (status != WT_OK)
        return status;
    size_t n_stored = size / sample_width(channel->lcd.encoding);
    channel->has_file = true;
    channel->n_points = isnan(announced) || n_stored < n ? n_stored : n;
    if (!isnan(announced) && size > n * sample_width(channel->lcd.encoding))
        wt_log_add(file->log, WT_WARNING, file->name, name,
                   "the channel has %zu bytes for %zu samples, which is too many: if some were "
                   "put in, those behind them are shifted",
                   size, n);
    return WT_OK;
}

static wt_status read_jpk_channel(jpk_file *file, jpk_segment *segment, const char *folder,
                                  jpk_channel *channel, wt_error *err)
{
    char prefix[JPK_NAME + 16];
    wt_error problem = WT_ERROR_INIT;
    snprintf(prefix, sizeof prefix, "channel.%s.", channel->name);
    wt_status status = read_lcd(file, segment, prefix, &channel->lcd, &problem);
    if (status == WT_E_MEMORY)
        return wt_fail(err, status, "%s", problem.message);
    channel->understood = status == WT_OK;
    if (!channel->understood) {
        wt_error_format(&problem, channel->problem, sizeof channel->problem);
        return WT_OK;
    }
    return find_channel_data(file, segment, prefix, folder, channel, err);
}

static wt_status read_channels(jpk_file *file, jpk_segment *segment, const char *folder,
                               wt_error *err)
{
    const char *list = properties_get(&segment->header, "channels.list");
    wt_status status = WT_OK;
    segment->n_channels = 0;
    while (status == WT_OK && segment->n_channels < JPK_CHANNELS) {
        jpk_channel *channel = &segment->channels[segment->n_channels];
        if (!property_next_token(&list, channel->name, sizeof channel->name))
            break;
        segment->n_channels++;
        /* `lcd` is large; read_jpk_channel fills it */
        channel->has_file = false;
        channel->n_points = 0;
        channel->problem[0] = '\0';
        status = read_jpk_channel(file, segment, folder, channel, err);
    }
    if (status == WT_OK && *list != '\0')
        status = wt_fail(err, WT_E_UNSUPPORTED, "list of channels too long");
    return status;
}

/* Truncates all channels of a segment to the shortest. Only channels with a data file limit the
 * length, since a raster may state any number. */
static void set_common_length(const jpk_file *file, jpk_segment *segment, const char *folder)
{
    size_t shortest = SIZE_MAX, longest = 0, raster = SIZE_MAX;
    segment->incomplete = false;
    for (size_t i = 0; i < segment->n_channels; i++) {
        const jpk_channel *c = &segment->channels[i];
        if (!c->understood)
            continue;
        if (c->lcd.raster) {
            raster = c->n_points < raster ? c->n_points : raster;
        } else if (c->has_file) {
            shortest = c->n_points < shortest ? c->n_points : shortest;
            longest = c->n_points > longest ? c->n_points : longest;
        } else {
            segment->incomplete = true;
        }
    }
    if (shortest == SIZE_MAX)
        shortest = 0;
    shortest = raster < shortest ? raster : shortest;
    segment->n_points = shortest;
    double announced = properties_number(&segment->header, "force-segment-header.", "num-points");
    bool cut = announced > (double)shortest || longest > shortest;
    segment->incomplete = segment->incomplete || cut;
    if (shortest > 0 && cut)
        wt_log_add(file->log, WT_LOSS, file->name, folder,
                   "channels are of different length; cut to the shortest");
}

wt_status jpk_segment_read(jpk_file *file, const jpk_segment_ref *ref, jpk_segment *segment,
                           wt_error *err)
{
    char folder[128];
    wt_status status = archive_read(file->archive, ref->entry, JPK_HEADER_MAX, &file->buffer, err);
    if (status == WT_OK)
        status = properties_parse(&segment->header, file->buffer.data, file->buffer.length, err);
    if (file->map)
        snprintf(folder, sizeof folder, "index/%u/segments/%u/", ref->curve, ref->segment);
    else
        snprintf(folder, sizeof folder, "segments/%u/", ref->segment);
    if (status == WT_OK)
        status = read_channels(file, segment, folder, err);
    if (status != WT_OK) {
        wt_error_place(err, "%s", folder);
        return status;
    }
    if (segment->n_channels == 0) /* a segment without duration lists its channels as well */
        wt_log_add(file->log, WT_WARNING, file->name, folder,
                   "the header of the segment lists no channels: it was cut or damaged, and "
                   "the segment is left out");
    read_settings(file, segment);
    set_common_length(file, segment, folder);
    return WT_OK;
}

const jpk_channel *jpk_segment_channel(const jpk_segment *segment, const char *name)
{
    for (size_t i = 0; i < segment->n_channels; i++)
        if (strcmp(segment->channels[i].name, name) == 0)
            return &segment->channels[i];
    return NULL;
}
