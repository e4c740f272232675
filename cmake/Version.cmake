# drape_version(SOURCE FALLBACK VARIABLE): sets the version after git's last tag vX.Y.Z: "0.2.0" at the tag, "0.2.0+15.g3f2a" 15
# commits later. Without a tag or a repository it sets FALLBACK.
function(drape_version source fallback variable)
  execute_process(
    COMMAND git -C ${source} describe --tags --match "v[0-9]*" --abbrev=8
    OUTPUT_VARIABLE described OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  if(described MATCHES "^v([0-9.]+)-([0-9]+)-(g[0-9a-f]+)$")
    set(${variable} "${CMAKE_MATCH_1}+${CMAKE_MATCH_2}.${CMAKE_MATCH_3}" PARENT_SCOPE)
  elseif(described MATCHES "^v([0-9.]+)$")
    set(${variable} "${CMAKE_MATCH_1}" PARENT_SCOPE)
  else()
    set(${variable} "${fallback}" PARENT_SCOPE)
  endif()
endfunction()
