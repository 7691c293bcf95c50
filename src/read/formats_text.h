/* Descriptions as files. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_READ_FORMATS_TEXT_H
#define WT_READ_FORMATS_TEXT_H

#include "read/description/description.h"

wt_status formats_parse_file(const description_schema *schema, const char *path,
                             text_description **description, wt_error *err);

#endif
