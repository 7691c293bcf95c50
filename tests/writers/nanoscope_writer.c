/* NanoScope force files for tests. SPDX-License-Identifier: GPL-3.0-or-later */
#include "writers/nanoscope_writer.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { DATA = 4096 };

static size_t samples(const nanoscope_writer_file *f)
{
    return f->n_in + f->n_hold + f->n_out;
}

static void write_header(const nanoscope_writer_file *f, FILE *out)
{
    fprintf(out,
            "\\*Force file list\r\n\\Version: 0x09200000\r\n\\Start context: %s\r\n"
            "\\Data length: %d\r\n\\Text: \r\n\\*Scanner list\r\n"
            "\\@Sens. Zsens: V %.10g nm/V\r\n\\*Ciao scan list\r\n"
            "\\Scan Size: %d nm\r\n\\Samps/line: 256\r\n\\Lines: 256\r\n",
            f->volume ? "FVOL" : "FOL", DATA, f->z_sensitivity, (int)f->side * 100);
    if (f->deflection_sensitivity > 0)
        fprintf(out, "\\@Sens. DeflSens: V %.10g \r\n", f->deflection_sensitivity);
    fprintf(out, "\\@Sens. ZsensSens: V 900 nm/V\r\n");
    if (f->amplitude > 0)
        fprintf(out,
                "\\PeakForce Capture: Allow\r\n\\Peak Force Amplitude: %.10g\r\n"
                "\\PFT Freq: 2 KHz\r\n\\Sample Points: %zu\r\n\\Sync Distance: %.10g\r\n",
                f->amplitude, samples(f), f->sync);
    fprintf(out,
            "\\*Ciao force list\r\n\\Forward vel.: %.10g\r\n\\Reverse vel.: %.10g\r\n"
            "\\Trigger mode: %s\r\n\\Hold Samples: %zu\r\n\\Hold Time: 0.5\r\n"
            "\\force/line: %zu 0\r\n\\@4:Trig Threshold Deflection: V [Sens. DeflSens] "
            "(0.0003750000 V/LSB) %.7f V\r\n\\@4:Ramp Size Zsweep: V [Sens. Zsens] "
            "(\\Data length V/LSB) %.10g V\r\n",
            f->rate, f->rate, f->trigger > 0 ? "Relative" : "Off", f->n_hold, f->side, f->trigger,
            f->ramp_volts);
    /* An image with more pixels than there are curves. */
    fprintf(out, "\\*Ciao image list\r\n\\Samps/line: 64\r\n\\Number of lines: 64\r\n");
}

static void write_count(const nanoscope_writer_file *f, double volts, double step, FILE *out)
{
    const double count = isnan(volts) ? f->width == 2 ? -32768 : -2147483648.0 : rint(volts / step);
    long long n = (long long)(isnan(volts) ? count : count * (f->scaled ? 256 : 1));
    for (unsigned i = 0; i < f->width; i++)
        fputc((int)((unsigned long long)n >> (8 * i) & 0xff), out);
}

int nanoscope_write(const nanoscope_writer_file *f)
{
    const size_t curves = f->volume ? f->side * f->side : 1, n = samples(f);
    size_t block = curves * (f->half > 0 ? 2 * f->half : n) * f->width;
    FILE *out = fopen(f->path, "wb");
    if (out == NULL)
        return -1;
    write_header(f, out);
    for (size_t c = 0; c < f->n_channels; c++) {
        const nanoscope_writer_channel *channel = &f->channels[c];
        fprintf(out,
                "\\*Ciao force image list\r\n\\Data offset: %zu\r\n\\Data length: %zu\r\n"
                "\\Bytes/pixel: 2\r\n\\Samps/line: %zu %zu\r\n",
                DATA + c * block, block, f->n_in, f->n_out);
        if (f->spring_constant > 0)
            fprintf(out, "\\Spring Constant: %.10g\r\n", f->spring_constant);
        fprintf(out,
                "\\@4:Image Data: S [X] \"%s\"\r\n"
                "\\@4:Z scale: V [%s] (%.10g V/LSB) 2.500000 V\r\n",
                channel->name, channel->soft, channel->step);
    }
    fprintf(out, "\\*File list end\r\n\032");
    while (ftell(out) < DATA)
        fputc(0, out);
    for (size_t c = 0; c < f->n_channels; c++)
        for (size_t curve = 0; curve < curves; curve++) {
            const double *values = f->channels[c].values;
            for (size_t i = 0; i < n; i++) {
                const size_t at = curve * n + (i < f->n_in ? f->n_in - 1 - i : i);
                write_count(f, values != NULL ? values[at] : 0, f->channels[c].step, out);
                for (size_t k = i + 1 == f->n_in ? f->n_in
                                : i + 1 == n     ? f->n_out
                                                 : f->half;
                     k < f->half; k++)
                    write_count(f, f->padding, f->channels[c].step, out);
            }
        }
    bool good = ferror(out) == 0;
    if (good && f->missing_bytes > 0) {
        const long end = ftell(out) - (long)f->missing_bytes;
        good = fclose(out) == 0;
        out = fopen(f->path, "rb+");
        unsigned char *bytes = malloc((size_t)end);
        good = good && out != NULL && bytes != NULL &&
               fread(bytes, 1, (size_t)end, out) == (size_t)end;
        if (out != NULL)
            fclose(out);
        out = fopen(f->path, "wb");
        good = good && out != NULL && fwrite(bytes, 1, (size_t)end, out) == (size_t)end;
        free(bytes);
    }
    return out != NULL && fclose(out) == 0 && good ? 0 : -1;
}
