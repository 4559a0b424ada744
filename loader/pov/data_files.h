// #fopen, #read and #fclose: numbers, vectors and strings from a file in the scene's folder.
#pragma once

#include "loader/pov/parser.h"

namespace lumivec::pov {

void open_data_file(Parser& parser);  // refuses to open for writing
void read_data_file(Parser& parser);  // at the file's end the file's name is forgotten
void close_data_file(Parser& parser);

}  // namespace lumivec::pov
