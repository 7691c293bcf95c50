/* Power spectra, through the reader that the file belongs to.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "base/shortage.h"
#include "read/formats.h"

wt_status wt_power_spectrum_read(const wt_formats *formats, wt_input *input,
                                 const wt_read_options *options, wt_parselog *log,
                                 wt_power_spectrum *spectrum, wt_error *err)
{
    wt_read_options o;
    const file_reader *reader = NULL;
    wt_input *content = NULL;
    wt_status status =
        read_start(formats, input, options, WT_KIND_SPECTRUM, &o, &reader, &content, err);
    if (status == WT_OK)
        status = reader->read_spectrum(reader, content, &o, log, spectrum, err);
    const wt_status end = shortage_end(status, err);
    if (status == WT_OK && end != WT_OK)
        wt_power_spectrum_clear(spectrum);
    status = end;
    if (status != WT_OK)
        wt_error_file(err, wt_input_name(input));
    return status;
}

wt_status wt_noise_read(const wt_formats *formats, wt_input *input, const wt_read_options *options,
                        wt_parselog *log, wt_noise_spectrum *spectrum, wt_error *err)
{
    wt_read_options o;
    const file_reader *reader = NULL;
    wt_input *content = NULL;
    wt_noise_spectrum made = {.n = 0};
    wt_status status =
        read_start(formats, input, options, WT_KIND_NOISE, &o, &reader, &content, err);
    if (status == WT_OK)
        status = reader->read_noise(reader, content, &o, log, &made, err);
    status = shortage_end(status, err);
    if (status == WT_OK) {
        *spectrum = made;
        return WT_OK;
    }
    wt_noise_spectrum_clear(&made);
    wt_error_file(err, wt_input_name(input));
    return status;
}
