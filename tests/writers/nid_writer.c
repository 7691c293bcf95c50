/* Writer of Nanosurf .nid files for tests and fixtures.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "writers/nid_writer.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>

nid_writer_file nid_writer_defaults(void)
{
    return (nid_writer_file){.spring_constant = (double)NAN,
                             .deflection_range_m = (double)NAN,
                             .deflection_range_v = (double)NAN};
}

static void put_main(const nid_writer_file *f, FILE *out)
{
    fprintf(out, "[DataSet]\r\nVersion=2\r\nGroupCount=%zu\r\n", f->n_groups);
    for (size_t g = 0; g < f->n_groups; g++) {
        const nid_writer_group *group = &f->groups[g];
        /* The count includes empty slots. */
        fprintf(out, "Gr%zu-Name=%s\r\nGr%zu-ID=%zu\r\nGr%zu-Count=%zu\r\n", g, group->name, g, g,
                g, group->channels[group->n_channels - 1].slot + 5);
        for (size_t c = 0; c < group->n_channels; c++) {
            size_t slot = group->channels[c].slot;
            fprintf(out, "Gr%zu-Ch%zu=DataSet-%zu:%zu\r\n", g, slot, g, slot);
        }
    }
    fprintf(out, "SetInfos=DataSet-Info\r\nInfoSetCount=0\r\n\r\n");
    const char *degree = f->latin1 ? "\260" : "\302\260";
    fprintf(out, "[DataSet-Info]\r\n-- Scan --=--------\r\nX-Slope=0 %s\r\n", degree);
    fprintf(out, "Head type=TEST-AFM\r\nSoftware ver.=3.10.0.0\r\nDate=01-02-2030\r\n%s\r\n",
            f->info != NULL ? f->info : "");
}

static void put_calibration(const nid_writer_file *f, FILE *out)
{
    if (!isnan(f->deflection_range_m))
        fprintf(out,
                "[DataSet\\Calibration\\Scanhead]\r\nVersion=6\r\nInCount=3\r\n"
                "In0=0,Channel0,Amplitude,V,5,0\r\nIn1=5,TipSignalDC,Deflection,m,%.17g,0\r\n"
                "In2=16,TipSignalDC1,Deflection,V,%.17g,0\r\n\r\n",
                f->deflection_range_m, f->deflection_range_v);
    if (!isnan(f->spring_constant))
        fprintf(out,
                "[DataSet\\Calibration\\Cantilever]\r\nVersion=2\r\nPropCount=2\r\n"
                "Prop0=D[%.17g]*[N/m]\r\nProp1=D[190000]*[Hz]\r\n\r\n",
                f->spring_constant);
}

static void put_timing(const nid_writer_file *f, FILE *out)
{
    if (f->forward_points == 0)
        return;
    fprintf(out, "[DataSet\\Parameters\\Spectroscopy]\r\nSubSectionCount=0\r\n");
    fprintf(out, "FwModTime=D[%.17g]*[s]\r\nFwModDatapoints=L[%zu]*[]\r\n", f->forward_time,
            f->forward_points);
    fprintf(out, "BwModTime=D[%.17g]*[s]\r\nBwModDatapoints=L[%zu]*[]\r\n", f->backward_time,
            f->backward_points);
    fprintf(out, "FwPauseTime=D[%.17g]*[s]\r\nFwPauseDatapoints=L[%zu]*[]\r\n", f->forward_pause,
            f->forward_pause_points);
    fprintf(out, "BwPauseTime=D[%.17g]*[s]\r\nBwPauseDatapoints=L[%zu]*[]\r\n", f->backward_pause,
            f->backward_pause_points);
    fprintf(out, "FwModRange=D[%.17g]*[m]\r\nBwModRange=D[%.17g]*[m]\r\n\r\n", f->forward_range,
            -f->forward_range);
}

static void put_positions(const nid_writer_file *f, FILE *out)
{
    if (f->map == NULL && f->n_positions == 0)
        return;
    fprintf(out,
            "[DataSet\\SpecInfos]\r\nSubSectionCount=2\r\nSubSection0=SpecHeader\r\n"
            "SubSection1=%s\r\n\r\n",
            f->map != NULL ? "SpecMapTable" : "SpecPosTable");
    fprintf(out, "[DataSet\\SpecInfos\\SpecHeader]\r\nSpecMode=%s\r\n\r\n",
            f->map != NULL ? "Map" : "Pos");
    if (f->map != NULL) {
        fprintf(out, "[DataSet\\SpecInfos\\SpecMapTable]\r\nCount=1\r\nMap0=%s\r\n\r\n", f->map);
        return;
    }
    fprintf(out,
            "[DataSet\\SpecInfos\\SpecPosTable]\r\nCount=%zu\r\nPosAxis=X;Y;Z\r\nPosUnit=m\r\n",
            f->n_positions);
    for (size_t i = 0; i < f->n_positions; i++)
        fprintf(out, "Pos%zu=%.17g;%.17g;%.17g\r\n", i, f->positions[i][0], f->positions[i][1],
                f->positions[i][2]);
    fprintf(out, "\r\n");
}

static void put_channel(const nid_writer_group *g, size_t number, const nid_writer_channel *c,
                        FILE *out)
{
    fprintf(out, "[DataSet-%zu:%zu]\r\nVersion=%d\r\nPoints=%zu\r\nLines=%zu\r\nFrame=%s\r\n",
            number, c->slot, g->line_points != NULL ? 3 : 2, g->points, g->lines, g->name);
    fprintf(out, "CurLine=%zu\r\n", g->lines - 1 - g->missed);
    fprintf(out, "Dim0Name=%s\r\nDim0Unit=%s\r\nDim0Range=%.17g\r\nDim0Min=0\r\n", g->x_name,
            g->x_unit, g->x_range);
    fprintf(out, "Dim1Name=%s\r\nDim1Unit=%s\r\nDim1Range=%.17g\r\nDim1Min=0\r\n", g->y_name,
            g->y_unit, g->y_range);
    fprintf(out, "Dim2Name=%s\r\nDim2Unit=%s\r\nDim2Range=%.17g\r\nDim2Min=%.17g\r\n", c->name,
            c->unit, c->range, c->minimum);
    for (size_t i = 0; g->line_points != NULL && i < g->lines; i++)
        fprintf(out, "LineDim%zuMin=0\r\nLineDim%zuRange=%.17g\r\nLineDim%zuPoints=%zu\r\n", i, i,
                g->x_range, i, g->line_points[i]);
    fprintf(out, "SaveMode=Binary\r\nSaveBits=%u\r\nSaveSign=Signed\r\nSaveOrder=Intel\r\n\r\n",
            c->bits);
}

static void put_block(const nid_writer_group *g, const nid_writer_channel *c, FILE *out)
{
    double whole = ldexp(1, (int)c->bits);
    for (size_t i = 0; i < g->lines * g->points; i++) {
        double raw = round((c->values[i] - c->minimum) / c->range * whole) - whole / 2;
        uint32_t bits = (uint32_t)((int64_t)raw & 0xffffffff);
        for (unsigned byte = 0; byte < c->bits / 8; byte++)
            fputc((int)(bits >> (8 * byte) & 0xff), out);
    }
}

int nid_write(const nid_writer_file *f)
{
    FILE *out = fopen(f->path, "wb");
    if (out == NULL) {
        perror(f->path);
        return -1;
    }
    put_main(f, out);
    put_calibration(f, out);
    put_timing(f, out);
    put_positions(f, out);
    for (size_t g = 0; g < f->n_groups; g++)
        for (size_t c = 0; c < f->groups[g].n_channels; c++)
            put_channel(&f->groups[g], g, &f->groups[g].channels[c], out);
    fprintf(out, "[SetView]\r\nViewCount=0\r\n\r\n#!");
    for (size_t g = 0; g < f->n_groups; g++)
        for (size_t c = 0; c < f->groups[g].n_channels; c++)
            put_block(&f->groups[g], &f->groups[g].channels[c], out);
    int bad = ferror(out);
    if (fclose(out) != 0 || bad != 0) {
        perror(f->path);
        return -1;
    }
    return 0;
}
