function x = @name@_numbers(x, what, sizes)
%@NAME@_NUMBERS  An argument as a real matrix of one of some sizes.

is_size = @(s) isequal(size(x), s);
if ~isnumeric(x) || ~isreal(x) || ~any(cellfun(is_size, sizes))
    sizes = cellfun(@(s) sprintf('%d x %d', s), sizes, 'UniformOutput', false);
    error('@name@:ik:argument', '%s must be real and %s, not %s %s.', what, strjoin(sizes, ' or '), ...
        mat2str(size(x)), class(x));
end
x = double(x);
end
