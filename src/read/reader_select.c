/* Selects the reader of a file and the options of reading. SPDX-License-Identifier:
 * GPL-3.0-or-later
 */
#include "core/base/memory.h"
#include "core/base/shared_params.h"
#include "read/formats.h"
#include "read/reader.h"

#include <math.h>
#include <string.h>

wt_read_options wt_read_defaults(void)
{
    return (wt_read_options){
        .format = NULL,
        .want = WT_Q_ALL,
        .segments = WT_SEGMENT_ALL,
        .spring_constant = (double)NAN,
        .sensitivity = (double)NAN,
        .temperature = (double)NAN,
        .units = NULL,
        .n_units = 0,
        .sheet = NULL,
        .strain = (double)NAN,
        .frequency = (double)NAN,
        .pixel_size = (double)NAN,
        .height_unit = NULL,
    };
}

static wt_status check_name_pattern(const void *member, wt_error *err)
{
    const char *pattern = *(const char *const *)member;
    const char *place = pattern != NULL ? strchr(pattern, '#') : NULL;
    if (pattern == NULL || (place != NULL && strchr(place + 1, '#') == NULL))
        return WT_OK;
    wt_fail(err, WT_E_ARG, "\"%s\" does not say where in a name the temperature stands", pattern);
    wt_error_expected(err, "one # in its place, such as \"*_#degC*\"");
    return WT_E_ARG;
}

static wt_status check_length_unit(const void *member, wt_error *err)
{
    const char *unit = *(const char *const *)member;
    double factor = 1, offset = 0;
    return unit == NULL ? WT_OK : wt_unit_to_si(unit, WT_Q_LENGTH, &factor, &offset, err);
}

static const wt_param rows[] = {
    SPRING_CONSTANT(wt_read_options, PARAM_NO_CASE, NULL),
    SENSITIVITY(wt_read_options, PARAM_NO_CASE, NULL),
    {PARAM("temperature", wt_read_options, temperature, WT_Q_TEMPERATURE, ABOVE(0)), .value = "T",
     .unset = "", .help = SUCH_AS("temperature of DMA files that state none, ", "20degC", "")},
    {PARAM_TEXT_OF("temperature-in-name", wt_read_options, temperature_in_name), .value = "PATTERN",
     .unset = "",
     .help = SUCH_AS("place of the temperature in the names of DMA files or sheets that state "
                     "none, in degrees Celsius: # is the number and * any text, ",
                     "\"*_#C.txt\"", ""),
     .check = check_name_pattern},
    {PARAM("frequency", wt_read_options, frequency, WT_Q_FREQUENCY, ABOVE(0)), .value = "F",
     .unset = "",
     .help = SUCH_AS("frequency of strain and temperature sweeps whose files state none, ", "10Hz",
                     "")},
    {PARAM_TEXTS_OF("units", wt_read_options, units, n_units), .value = "NAME=UNIT", .unset = "",
     .help = "unit of a column for which the file states none, such as \"E'=MPa\"; repeatable"},
    {PARAM("pixel-size", wt_read_options, pixel_size, WT_Q_LENGTH, ABOVE(0)), .value = "L",
     .unset = "",
     .help = SUCH_AS("pixel spacing of height maps whose files do not state their size, ", "0.5um",
                     "")},
    {PARAM_TEXT_OF("height-unit", wt_read_options, height_unit), .value = "UNIT", .unset = "",
     .help = "unit of the values of height maps whose files state no unit of length, such as nm",
     .check = check_length_unit},
    {PARAM_CHOICE_OF("spectrum-convention", wt_read_options, spectrum_convention,
                     "weartrack|contact-engineering"),
     .help = "definition of the density of a power spectrum; densities of contact.engineering "
             "(SurfaceTopography) are divided by (2 pi)^2 for an area and by 2 pi for a profile"},
    {PARAM_TEXT_OF("format", wt_read_options, format), .value = "ID", .unset = "",
     .help = "read the files as this format (see weartrack formats list)"},
    {PARAM_TEXT_OF("sheet", wt_read_options, sheet), .value = "NAME", .unset = "",
     .help = "sheet of a spreadsheet file; all reads every sheet that holds data, one after the "
             "other; default: the only sheet that holds data"},
    {PARAM_CHOICE_OF("deformation", wt_read_options, deformation, "of-file|tension|shear|bending"),
     .help = "deformation that the moduli of a DMA file belong to if their names do not state it, "
             "as in \"storage modulus\"; bending gives E like tension"},
    {PARAM("strain", wt_read_options, strain, WT_Q_STRAIN, ABOVE(0)), .value = "S", .unset = "",
     .help = SUCH_AS("select the DMA isotherms and temperature sweeps with the strain amplitude "
                     "nearest to this one, ",
                     "0.1%", ", if there are several amplitudes")},
    {PARAM_TEXT_OF("sample", wt_read_options, sample), .value = "NAME", .unset = "",
     .help = "select the DMA sweeps of this sample, or its result of weartrack master; all: the "
             "sweeps are of one material whatever their names are"},
    {PARAM_CHOICE_OF("sample-by", wt_read_options, sample_by, "name|file"),
     .help = "how the samples of DMA sweeps are distinguished: by the name in a column or in "
             "the header, or by the file"},
    {PARAM_CHOICE_OF("conditioning", wt_read_options, conditioning, "mend|keep"),
     .help = "mend leaves out or corrects copies, flagged rows, outliers, pauses, zeros and "
             "drifts; keep uses them as they are"},
};

PARAM_TABLE(wt_read_params, wt_read_options, rows, wt_read_defaults, NO_PARTS)

wt_status read_start(const wt_formats *formats, wt_input *input, const wt_read_options *given,
                     unsigned kind, read_request *request, wt_error *err)
{
    resource_error_clear();
    *request = (read_request){.options = given != NULL ? *given : wt_read_defaults()};
    wt_status status = param_check(wt_read_params(), &request->options, err);
    if (status != WT_OK)
        return status;
    return find_reader(formats, input, &request->options, kind, &request->reader, &request->content,
                       err);
}

wt_status read_end(wt_input *input, wt_status status, wt_error *err)
{
    status = resource_error_finish(status, err);
    if (status != WT_OK)
        wt_error_file(err, wt_input_name(input));
    return status;
}
